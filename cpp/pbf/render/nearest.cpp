#include "pbf/render/nearest.hpp"

#include "pbf/core/parallel.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pbf {
namespace {

struct Nearest {
  Real depth = std::numeric_limits<Real>::max();
  Nearest& operator+=(const Nearest& other) {
    depth = std::min(depth, other.depth);
    return *this;
  }
};

}  // namespace

Real nearest_front(const PointsView& positions, Real radius, const FrameBlock& frame, int threads) {
  const Eigen::Map<const Eigen::Matrix4f> view(frame.view.data());
  const auto [half_width, half_height, near, far] = frame.lens;
  const bool perspective = frame.size[2] > 0.5F;
  // A sphere reaches over a side of the picture by its radius, measured across that side.
  const Real beyond_x = radius * (perspective ? std::hypot(1.0F, half_width) : 1);
  const Real beyond_y = radius * (perspective ? std::hypot(1.0F, half_height) : 1);
  const Nearest found = parallel_sum<Nearest>(positions.cols(), threads, [&](Index i) -> Nearest {
    const Vec3 center = view.topLeftCorner<3, 3>() * positions.col(i) + view.topRightCorner<3, 1>();
    const Real depth = -center.z();
    const Real spread = perspective ? depth : 1;
    const bool seen = depth + radius > near && depth - radius < far &&
                      std::abs(center.x()) < half_width * spread + beyond_x &&
                      std::abs(center.y()) < half_height * spread + beyond_y;
    return seen ? Nearest{std::max(depth - radius, near)} : Nearest{};
  });
  return std::min(found.depth, far);
}

}  // namespace pbf
