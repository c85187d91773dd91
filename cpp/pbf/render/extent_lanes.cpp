// Compiled once per instruction set (cpp/pbf_render.cmake).
#include "pbf/core/lanes.hpp"
#include "pbf/render/extent_kernels.hpp"

namespace pbf::PBF_ISA_NAMESPACE {
namespace {

constexpr int kVectors = static_cast<int>(kMostLanes) / kLanes;
/// More than any coordinate that counts.
constexpr float kLargest = 3e38F;

void measure(const Real* xyz, Index count, const ExtentAxes& to, ExtentPart (&parts)[3]) {
  Lanes lower[3], upper[3], sums[3][kVectors], squares[3][kVectors];
  for (int axis = 0; axis < 3; ++axis) {
    lower[axis] = kLargest;
    upper[axis] = -kLargest;
    for (int v = 0; v < kVectors; ++v) sums[axis][v] = squares[axis][v] = 0.0F;
  }
  for (Index i = 0; i < count; i += kMostLanes) {
    for (int v = 0; v < kVectors; ++v) {
      const Index first = i + v * kLanes;
      if (first >= count) break;
      const Vec3Lanes p = load_points(xyz + 3 * first);
      const Mask is_particle = first_lanes(count - first);
      for (int axis = 0; axis < 3; ++axis) {
        const auto& a = to.axes[axis];
        const Lanes along = a[0] * p.x + a[1] * p.y + a[2] * p.z;
        const Lanes x = min(max(along, -ExtentAxes::kBeyond), ExtentAxes::kBeyond);
        const Mask counts =
            is_particle & (Lanes(to.least[axis]) <= x) & (x <= Lanes(to.most[axis]));
        lower[axis] = min(select(counts, x, kLargest), lower[axis]);
        upper[axis] = max(select(counts, x, -kLargest), upper[axis]);
        const Lanes difference = select(counts, x - to.origin[axis], 0.0F);
        sums[axis][v] += difference;
        squares[axis][v] += difference * difference;
      }
    }
  }
  for (int axis = 0; axis < 3; ++axis) {
    ExtentPart& part = parts[axis];
    part.lower = kLargest;
    part.upper = -kLargest;
    for (int lane = 0; lane < kLanes; ++lane) {
      part.lower = lower[axis].v[lane] < part.lower ? lower[axis].v[lane] : part.lower;
      part.upper = upper[axis].v[lane] > part.upper ? upper[axis].v[lane] : part.upper;
    }
    std::memcpy(part.sums, sums[axis], sizeof part.sums);
    std::memcpy(part.squares, squares[axis], sizeof part.squares);
  }
}

}  // namespace

const ExtentKernels& extent_kernels() {
  static constexpr ExtentKernels table{measure};
  return table;
}

}  // namespace pbf::PBF_ISA_NAMESPACE
