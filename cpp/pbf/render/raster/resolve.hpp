#pragma once

#include "pbf/render/image.hpp"
#include "pbf/render/raster/picture.hpp"

namespace pbf::raster {

/// Linear light of the 256 values that an sRGB-encoded color can have.
const float* light_of_srgb();

/// A finished picture to draw into, which `image` must outlive.
Picture picture_of(Image& image);

/// The pass of the same name in C++: the mean of factor² pixels in linear light, divided by alpha.
/// @param picture  `factor` times as wide and high as `out`
void resolve(const Picture& picture, int factor, const Picture& out, int threads);

}  // namespace pbf::raster
