#pragma once

#include "pbf/render/camera.hpp"
#include "pbf/render/image.hpp"
#include "pbf/render/params.hpp"
#include "pbf/render/raster/map.hpp"

namespace pbf::raster {

/// The pass normal in C++: unit normals in eye space, 0 where there is no fluid.
/// @param depth    affine depth
/// @param spheres  that of the spheres, with their crowding
Pixels<float> normal(const Map& depth,
                     const Map& spheres,
                     const Tiles& tiles,
                     const Camera& camera,
                     const RenderParams& params,
                     int threads);

// Maps as layers, row 0 on top.
Pixels<float> pixels(const Map& map);
/// Affine depth as depth [m], 0 where there is no fluid.
Pixels<float> depth_pixels(const Map& map, const Camera& camera);

}  // namespace pbf::raster
