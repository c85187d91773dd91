#pragma once

#include "pbf/render/camera.hpp"
#include "pbf/render/params.hpp"

#include <array>

namespace pbf {

/// The uniform block of glsl/frame.glsl, std140: what every pass needs to know about the camera.
struct FrameBlock {
  std::array<float, 16> view;
  std::array<float, 4> lens;
  std::array<float, 4> size;
};
static_assert(sizeof(FrameBlock) == 96);

/// Affine depth where there is no fluid.
inline constexpr float kNothing = -1e30F;

FrameBlock frame_block(const Camera& camera, int width, int height);

}  // namespace pbf
