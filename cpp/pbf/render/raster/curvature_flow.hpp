#pragma once

#include "pbf/render/flow_schedule.hpp"
#include "pbf/render/raster/map.hpp"

#include <array>

namespace pbf::raster {

/// Moves the surface by its curvature; what the pass CurvatureFlow does.
/// @param depth    affine depth   @param spheres  the same, with crowding
/// @param maps     are written; the last stage's is the first of them
void curvature_flow(const LayerFilter& filter,
                    const FlowSchedule& schedule,
                    const FrameBlock& frame,
                    const Tiles& tiles,
                    const Map& depth,
                    const Map& spheres,
                    const std::array<Map*, 3>& maps,
                    int threads);

}  // namespace pbf::raster
