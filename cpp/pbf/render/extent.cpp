#include "pbf/render/extent.hpp"

#include "pbf/core/parallel.hpp"
#include "pbf/render/extent_kernels.hpp"
#include "pbf/render/point_block.hpp"

#include <vector>

namespace pbf {
PBF_TABLE_BY_ISA(ExtentKernels, extent_kernels, extent_kernels)
namespace {

constexpr double kFarthest = 6;    // [root mean squares]
constexpr Index kBlock = 1 << 12;  // positions that are added up at a time

/// Of a block's coordinates.
struct Part {
  Eigen::Array3d lower = Eigen::Array3d::Constant(Extent::kNone);
  Eigen::Array3d upper = Eigen::Array3d::Constant(-Extent::kNone);
  Eigen::Array3d sum = Eigen::Array3d::Zero(), squares = Eigen::Array3d::Zero();

  Part& operator+=(const Part& other) {
    lower = lower.min(other.lower);
    upper = upper.max(other.upper);
    sum += other.sum;
    squares += other.squares;
    return *this;
  }
};

Part part_of(const ExtentPart (&along)[3]) {
  Part part;
  for (int axis = 0; axis < 3; ++axis) {
    const ExtentPart& from = along[axis];
    part.lower[axis] = static_cast<double>(from.lower);
    part.upper[axis] = static_cast<double>(from.upper);
    for (const float sum : from.sums) part.sum[axis] += static_cast<double>(sum);
    for (const float square : from.squares) part.squares[axis] += static_cast<double>(square);
  }
  return part;
}

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
  constexpr Real kBeyond = ExtentAxes::kBeyond;
  const Vec3 first = (axes * positions.col(0)).cwiseMax(-kBeyond).cwiseMin(kBeyond);
  ExtentAxes to{};
  for (int axis = 0; axis < 3; ++axis) {
    for (int k = 0; k < 3; ++k) to.axes[axis][k] = axes(axis, k);
    to.origin[axis] = first[axis];
    to.least[axis] = -kBeyond;
    to.most[axis] = kBeyond;
  }
  const ExtentKernels& kernels = extent_kernels(chosen_isa());
  std::vector<Part> parts(static_cast<std::size_t>((n + kBlock - 1) / kBlock));
  const auto measured = [&] {
    parallel_chunks(n, threads, kBlock, [&](Index begin, Index end) {
      ExtentPart along[3];
      kernels.measure(point_block(positions, begin, end), end - begin, to, along);
      parts[static_cast<std::size_t>(begin / kBlock)] = part_of(along);
    });
    Part all;
    for (const Part& part : parts) all += part;
    return all;
  };
  Part all = measured();
  const Eigen::Array3d origin = first.cast<double>().array();
  const Eigen::Array3d mean = all.sum / static_cast<double>(n);
  const Eigen::Array3d variance = all.squares / static_cast<double>(n) - mean.square();
  result.mean = origin + mean;
  // Rounding must not leave out one of few that are all alike.
  result.limit = kFarthest * variance.max(0).sqrt() + 1e-6 * result.mean.abs();
  const Eigen::Array3f least = (result.mean - result.limit).cast<Real>();
  const Eigen::Array3f most = (result.mean + result.limit).cast<Real>();
  if ((all.lower < least.cast<double>()).any() || (all.upper > most.cast<double>()).any()) {
    for (int axis = 0; axis < 3; ++axis) {
      to.least[axis] = least[axis];
      to.most[axis] = most[axis];
    }
    all = measured();
  }
  result.lower = all.lower;
  result.upper = all.upper;
  return result;
}

}  // namespace pbf
