#pragma once

#include "pbf/render/camera.hpp"
#include "pbf/render/environment.hpp"
#include "pbf/render/sun_shadow.hpp"

namespace pbf {

/// Pixels, row 0 below: x0 <= x < x1, y0 <= y < y1.
struct Rectangle {
  int x0, y0, x1, y1;
};

/// Where on the floor the shadow can be seen.
Rectangle shadow_rectangle(const SunShadow& shadow,
                           const Camera& camera,
                           const Environment& environment,
                           int width,
                           int height);

}  // namespace pbf
