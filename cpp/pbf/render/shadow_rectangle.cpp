#include "pbf/render/shadow_rectangle.hpp"

#include <cmath>

namespace pbf {

Rectangle shadow_rectangle(const SunShadow& shadow,
                           const Camera& camera,
                           const Environment& environment,
                           int width,
                           int height) {
  if (shadow.casts_none()) return {0, 0, 0, 0};
  const Vec3 up(environment.up.x, environment.up.y, environment.up.z);
  const Vec3 sun(environment.sun.x, environment.sun.y, environment.sun.z);
  const Eigen::Matrix4f view = camera.view();
  const Vec3 across_x = shadow.x / shadow.x.squaredNorm();
  const Vec3 across_y = shadow.y / shadow.y.squaredNorm();
  Eigen::Array2f low(1, 1), high(-1, -1);  // of the picture, -1 to 1
  for (int k = 0; k < 4; ++k) {
    const Real u = (k & 1) == 0 ? -0.5F : 0.5F;
    const Real v = (k & 2) == 0 ? -0.5F : 0.5F;
    const Vec3 corner = shadow.center + u * across_x + v * across_y;
    const Vec3 on_floor = corner - (up.dot(corner) - environment.floor_height) / up.dot(sun) * sun;
    const Vec3 p = view.topLeftCorner<3, 3>() * on_floor + view.topRightCorner<3, 1>();
    const float depth = camera.orthographic ? 1 : -p.z();
    const Eigen::Array2f at =
        p.head<2>().array() / (depth * camera.half_height()) *
        Eigen::Array2f(static_cast<float>(height) / static_cast<float>(width), 1);
    // Behind the eye, or too far away to be a number: it may be anywhere.
    if (-p.z() < camera.near || !at.isFinite().all()) return {0, 0, width, height};
    low = low.min(at);
    high = high.max(at);
  }
  low = 0.5F * low.max(-1).min(1) + 0.5F;
  high = 0.5F * high.max(-1).min(1) + 0.5F;
  const auto w = static_cast<float>(width);
  const auto h = static_cast<float>(height);
  return {static_cast<int>(low.x() * w), static_cast<int>(low.y() * h),
          static_cast<int>(std::ceil(high.x() * w)), static_cast<int>(std::ceil(high.y() * h))};
}

}  // namespace pbf
