#pragma once

#include "pbf/render/affine_depth.hpp"
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

FrameBlock frame_block(const Camera& camera, int width, int height);

}  // namespace pbf
