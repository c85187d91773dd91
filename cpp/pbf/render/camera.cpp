#include "pbf/render/camera.hpp"

#include <Eigen/Geometry>

#include <numbers>

namespace pbf {

Eigen::Matrix4f Camera::view() const {
  const Vec3 z = (eye - target).normalized();
  const Vec3 x = up.normalized().cross(z).normalized();
  const Vec3 y = z.cross(x);
  Eigen::Matrix4f result = Eigen::Matrix4f::Identity();
  result.block<1, 3>(0, 0) = x.transpose();
  result.block<1, 3>(1, 0) = y.transpose();
  result.block<1, 3>(2, 0) = z.transpose();
  // In double: far from the origin the products are large and their difference is small.
  const Eigen::Matrix3d rotation = result.block<3, 3>(0, 0).cast<double>();
  result.block<3, 1>(0, 3) = (-rotation * eye.cast<double>()).cast<float>();
  return result;
}

Real Camera::half_height() const {
  if (orthographic) return 0.5F * height;
  return static_cast<Real>(std::tan(static_cast<double>(fov_y) * std::numbers::pi / 360.0));
}

void Camera::check_together(Faults& faults) const {
  const Vec3 view_axis = target - eye;
  if (!(view_axis.norm() > 0)) {
    faults.add("target", target, "m", "must differ from eye; move one of them");
  } else if (!(up.norm() > 0)) {
    faults.add("up", up, "", "must not be zero; (0, 1, 0) for a scene whose y points up");
  } else if (view_axis.normalized().cross(up.normalized()).norm() < 1e-4F) {
    faults.add(
        "up", up, "",
        "must not be parallel to the viewing direction; give another axis, such as (0, 0, -1) "
        "to look straight down y");
  }
  if (!(near < far)) faults.add("near", near, "m", "must be less than far = " + to_text(far));
}

}  // namespace pbf
