#include "pbf/fluid/coarse_grid.hpp"

#include <cmath>

namespace pbf {
namespace {

/// Wide enough that a cell has two hundred particles, and the corners are little work beside them;
/// narrow enough that iterations smooth what is between.
constexpr Real kSpacings = 6;

// A whole number per axis, from -2^20 to 2^20.
constexpr int kBits = 21;
constexpr std::int64_t kZero = std::int64_t{1} << (kBits - 1);

}  // namespace

CoarseGrid::CoarseGrid(const Discretization& disc) {
  const Real width = kSpacings * disc.fluid.spacing;
  for (int k = 0; k < disc.fluid.dimensions; ++k) {
    Axis& axis = axes_[static_cast<std::size_t>(k)];
    axis.per_width = 1 / width;
    if (!disc.domain) continue;
    const Box& domain = *disc.domain;
    axis.origin = domain.lower[k];
    if (!domain.periodic[static_cast<std::size_t>(k)]) continue;
    const Real period = domain.upper[k] - domain.lower[k];
    const Real cells = std::max(std::floor(period / width), Real(1));
    axis.per_width = cells / period;
    axis.period = static_cast<std::int64_t>(cells);
  }
}

CoarseGrid::Hats CoarseGrid::at(const Record& x) const {
  Hats hats{};
  hats.w.fill(1);
  for (auto& slopes : hats.dw) slopes.fill(1);
  const Real place[] = {x.x, x.y, x.z};
  for (int k = 0; k < 3; ++k) {
    const Axis& axis = axes_[static_cast<std::size_t>(k)];
    const Real s = (place[k] - axis.origin) * axis.per_width;
    // What is no number, or too far off, is found and reported at the end of the step.
    auto cell = std::abs(s) < static_cast<Real>(kZero) - 2
                    ? static_cast<std::int64_t>(std::floor(s))
                    : std::int64_t{0};
    const Real f = s - static_cast<Real>(cell);
    if (axis.period > 0) cell = (cell % axis.period + axis.period) % axis.period;
    hats.cell |= static_cast<CellKey>(cell + kZero) << (k * kBits);
    for (int corner = 0; corner < kCorners; ++corner) {
      const auto c = static_cast<std::size_t>(corner);
      const bool upper = (corner >> k & 1) != 0;
      const Real w = upper ? f : 1 - f;
      const Real slope = upper ? axis.per_width : -axis.per_width;
      hats.w[c] *= w;
      for (int m = 0; m < 3; ++m) hats.dw[static_cast<std::size_t>(m)][c] *= m == k ? slope : w;
    }
  }
  return hats;
}

CellKey CoarseGrid::corner(CellKey cell, int number) const {
  CellKey key = 0;
  for (int k = 0; k < 3; ++k) {
    const Axis& axis = axes_[static_cast<std::size_t>(k)];
    auto c = static_cast<std::int64_t>(cell >> (k * kBits) & ((CellKey{1} << kBits) - 1)) - kZero;
    c += number >> k & 1;
    if (axis.period > 0) c %= axis.period;
    key |= static_cast<CellKey>(c + kZero) << (k * kBits);
  }
  return key;
}

}  // namespace pbf
