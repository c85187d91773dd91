#pragma once

#include "pbf/core/fields.hpp"

namespace pbf {

/// Where the picture is taken from. In eye space x points right, y up and z out of the picture:
/// what is seen has negative z; depth is -z [m].
struct Camera {
  Vec3 eye{3.0F, 2.0F, 3.0F};
  Vec3 target{0.0F, 0.0F, 0.0F};
  Vec3 up{0.0F, 1.0F, 0.0F};
  Real fov_y = 45.0F;
  bool orthographic = false;
  Real height = 2.0F;
  Real near = 0.01F;
  Real far = 1000.0F;

  /// Rigid motion from world to eye space.
  [[nodiscard]] Eigen::Matrix4f view() const;
  /// Half the height of what is seen: at depth 1 in perspective, at every depth in parallel [m].
  [[nodiscard]] Real half_height() const;

  static constexpr const char* kName = "Camera";
  static auto fields() {
    return std::tuple{
        Field{"eye", &Camera::eye, "m", between(-1e9, 1e9), "Where the camera stands."},
        Field{"target", &Camera::target, "m", between(-1e9, 1e9), "The point in mid-picture."},
        Field{"up", &Camera::up, "", between(-1e9, 1e9),
              "The direction that points up in the picture. Any length but zero."},
        Field{"fov_y", &Camera::fov_y, "degrees", inside(0.01, 179),
              "Vertical field of view. Not used if orthographic."},
        Field{"orthographic", &Camera::orthographic, "", anything(),
              "Parallel projection: no vanishing points, and every pixel the same area."},
        Field{"height", &Camera::height, "m", inside(1e-12, 1e9),
              "Height of the picture in the scene, if orthographic."},
        Field{"near", &Camera::near, "m", inside(1e-12, 1e9),
              "Fluid nearer than this is cut off. Along the viewing direction, as far is."},
        Field{"far", &Camera::far, "m", inside(0, 1e12), "Fluid beyond this is cut off."},
    };
  }
  void check_together(Faults& faults) const;
};

}  // namespace pbf
