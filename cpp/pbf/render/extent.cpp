#include "pbf/render/extent.hpp"

#include "pbf/core/parallel.hpp"

#include <limits>
#include <vector>

namespace pbf {
namespace {

constexpr double kFarthest = 6;    // [root mean squares]
constexpr float kBeyond = 1e30F;   // coordinates end here: what is added up stays finite
constexpr Index kBlock = 1 << 12;  // positions that are added up at a time
using Four = Eigen::Array4f;       // three numbers in one vector
using Four64 = Eigen::Array4d;

/// Of a block's coordinates.
struct Part {
  Four lower = Four::Constant(std::numeric_limits<float>::max());
  Four upper = Four::Constant(std::numeric_limits<float>::lowest());
  Four64 sum = Four64::Zero(), squares = Four64::Zero();
};

}  // namespace

void Extent::include(const Eigen::Array3d& at) {
  const auto counts = (at - mean).abs() <= limit;
  lower = counts.select(lower.min(at), lower);
  upper = counts.select(upper.max(at), upper);
}

Extent extent(const PointsView& positions, const Eigen::Matrix<Real, 3, 3>& axes, int threads) {
  Extent result;
  const Index n = positions.cols();
  if (n == 0) return result;
  Eigen::Matrix<Real, 4, 3> rows = Eigen::Matrix<Real, 4, 3>::Zero();
  rows.topRows<3>() = axes;
  const Four along_x = rows.col(0), along_y = rows.col(1), along_z = rows.col(2);
  const auto at = [&](Index i) -> Four {
    const Four p =
        along_x * positions(0, i) + along_y * positions(1, i) + along_z * positions(2, i);
    return p.max(-kBeyond).min(kBeyond);
  };
  std::vector<Part> parts(static_cast<std::size_t>((n + kBlock - 1) / kBlock));
  const auto for_parts = [&](auto&& add) {
    parallel_chunks(n, threads, kBlock, [&](Index first, Index last) {
      Part part;
      for (Index i = first; i < last; ++i) add(part, at(i));
      parts[static_cast<std::size_t>(first / kBlock)] = part;
    });
    Part all;
    for (const Part& part : parts) {
      all.lower = all.lower.min(part.lower);
      all.upper = all.upper.max(part.upper);
      all.sum += part.sum;
      all.squares += part.squares;
    }
    return all;
  };
  const Four64 origin = at(0).cast<double>();
  Part all = for_parts([&](Part& part, const Four& p) {
    part.lower = part.lower.min(p);
    part.upper = part.upper.max(p);
    const Four64 from_origin = p.cast<double>() - origin;
    part.sum += from_origin;
    part.squares += from_origin.square();
  });
  const Four64 mean = all.sum / static_cast<double>(n);
  const Four64 variance = all.squares / static_cast<double>(n) - mean.square();
  result.mean = (origin + mean).head<3>();
  // Rounding must not leave out one of few that are all alike.
  const Four64 limit = kFarthest * variance.max(0).sqrt() + 1e-6 * (origin + mean).abs();
  result.limit = limit.head<3>();
  const Four least = (origin + mean - limit).cast<float>();
  const Four most = (origin + mean + limit).cast<float>();
  if ((all.lower < least).any() || (all.upper > most).any()) {
    all = for_parts([&](Part& part, const Four& p) {
      const auto counts = least <= p && p <= most;
      part.lower = counts.select(part.lower.min(p), part.lower);
      part.upper = counts.select(part.upper.max(p), part.upper);
    });
  }
  result.lower = all.lower.head<3>().cast<double>();
  result.upper = all.upper.head<3>().cast<double>();
  return result;
}

}  // namespace pbf
