#pragma once

#include "pbf/render/frame_block.hpp"
#include "pbf/render/layer_filter.hpp"
#include "pbf/render/raster/map.hpp"

namespace pbf::raster {

/// One iteration of a separable filter over a layer: rows, then columns; what the pass Smooth does.
/// @param values   affine depth, or thickness [m]
/// @param spheres  affine depth of the spheres, with crowding
/// @param between  is written in between   @param out  may be `values`
void smooth(const LayerFilter& filter,
            const FrameBlock& frame,
            const Tiles& tiles,
            const Map& values,
            const Map& spheres,
            Map& between,
            Map& out,
            int threads);

}  // namespace pbf::raster
