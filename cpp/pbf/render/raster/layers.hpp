#pragma once

#include "pbf/render/camera.hpp"
#include "pbf/render/image.hpp"
#include "pbf/render/raster/normal.hpp"

namespace pbf::raster {

// Maps as layers, row 0 on top.
Pixels<float> pixels(const Map& map);
Pixels<float> pixels(const NormalMaps& maps);
/// Affine depth as depth [m], 0 where there is no fluid.
Pixels<float> depth_pixels(const Map& map, const Camera& camera);

}  // namespace pbf::raster
