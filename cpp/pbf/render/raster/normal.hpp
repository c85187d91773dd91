#pragma once

#include "pbf/render/frame_block.hpp"
#include "pbf/render/params.hpp"
#include "pbf/render/raster/map.hpp"

namespace pbf::raster {

/// Unit normals in eye space, 0 where there is no fluid.
struct NormalMaps {
  NormalMaps(int width, int height)
      : x(width, height, 0), y(width, height, 0), z(width, height, 0) {}
  Map x, y, z;
};

/// The pass normal in C++.
/// @param depth    affine depth
/// @param spheres  that of the spheres, with their crowding
void normal(const Map& depth,
            const Map& spheres,
            const Tiles& tiles,
            const FrameBlock& frame,
            const RenderParams& params,
            NormalMaps& out,
            int threads);

}  // namespace pbf::raster
