#pragma once

#include "pbf/gl/texture.hpp"
#include "pbf/render/camera.hpp"
#include "pbf/render/image.hpp"

namespace pbf {

// Textures to memory, row 0 on top.
Image read_rgba8(const Texture& texture);
/// @param channels  1, or 3 of a texture of four
Pixels<float> read_floats(const Texture& texture, int channels);
/// Affine depth (glsl/frame.glsl) as depth [m], 0 where there is no fluid.
Pixels<float> read_depth(const Texture& texture, const Camera& camera);

}  // namespace pbf
