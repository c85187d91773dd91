#include "pbf/neighbors/cell_grid.hpp"

#include "pbf/core/error.hpp"
#include "pbf/core/parallel.hpp"

#include <bit>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace pbf {
namespace {

struct Bounds {
  Eigen::Array3d lower = Eigen::Array3d::Constant(std::numeric_limits<double>::max());
  Eigen::Array3d upper = Eigen::Array3d::Constant(std::numeric_limits<double>::lowest());
};

Bounds bounds_of(const PointsView& x, double farthest) {
  Bounds bounds;
  for (Index i = 0; i < x.cols(); ++i) {
    const Eigen::Array3d p = x.col(i).cast<double>().array();
    if (!(p.abs() <= farthest).all()) {  // false for NaN as well
      throw SimulationFailed(
          "particle positions: (" + std::to_string(p[0]) + ", " + std::to_string(p[1]) + ", " +
          std::to_string(p[2]) + ") m is not within " + std::to_string(farthest) +
          " m (2^20 support radii) of the origin; use a smaller time step or a domain");
    }
    bounds.lower = bounds.lower.min(p);
    bounds.upper = bounds.upper.max(p);
  }
  return bounds;
}

}  // namespace

void CellGrid::build(const PointsView& x, Real h, int threads) {
  const Index n = x.cols();
  if (n >= std::numeric_limits<std::uint32_t>::max()) {
    throw InvalidParameter("particles: " + std::to_string(n) +
                           " are more than the 4294967294 that a grid can hold");
  }
  entries_.resize(static_cast<std::size_t>(n));
  order_.resize(entries_.size());
  keys_.clear();
  starts_.clear();
  if (n == 0) return;

  const double cell = static_cast<double>(h) * (1 + 1e-6);
  const Bounds bounds = bounds_of(x, kFarthestCell * static_cast<double>(h));
  // One empty cell around the bounds: a row that leaves the grid then meets keys that no particle
  // has.
  const auto cells = [&](int axis) {
    return static_cast<std::uint64_t>((bounds.upper[axis] - bounds.lower[axis]) / cell) + 3;
  };
  stride_y_ = cells(0);
  stride_z_ = stride_y_ * cells(1);
  parallel_for(n, threads, [&](Index i) {
    const Eigen::Array3d c = (x.col(i).cast<double>().array() - bounds.lower) / cell;
    const auto key = (static_cast<std::uint64_t>(c[0]) + 1) +
                     (static_cast<std::uint64_t>(c[1]) + 1) * stride_y_ +
                     (static_cast<std::uint64_t>(c[2]) + 1) * stride_z_;
    entries_[static_cast<std::size_t>(i)] = {key, static_cast<std::uint32_t>(i)};
  });
  sort_entries(stride_z_ * cells(2));

  for (std::size_t k = 0; k < entries_.size(); ++k) {
    order_[k] = entries_[k].particle;
    if (k == 0 || entries_[k].key != keys_.back()) {
      keys_.push_back(entries_[k].key);
      starts_.push_back(static_cast<std::uint32_t>(k));
    }
  }
  starts_.push_back(static_cast<std::uint32_t>(n));
}

/// Radix sort from the lowest digit, which is stable: the order is a function of positions and
/// input order alone.
void CellGrid::sort_entries(std::uint64_t largest_key) {
  constexpr int kDigitBits = 11;
  constexpr std::uint64_t kDigits = 1 << kDigitBits;
  scratch_.resize(entries_.size());
  const auto key_bits = static_cast<int>(std::bit_width(largest_key));
  for (int shift = 0; shift < key_bits; shift += kDigitBits) {
    std::array<std::uint32_t, kDigits> place{};
    for (const Entry& e : entries_) ++place[(e.key >> shift) % kDigits];
    std::uint32_t sum = 0;
    for (std::uint32_t& p : place) sum += std::exchange(p, sum);
    for (const Entry& e : entries_) scratch_[place[(e.key >> shift) % kDigits]++] = e;
    entries_.swap(scratch_);
  }
}

}  // namespace pbf
