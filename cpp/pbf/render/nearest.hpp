#pragma once

#include "pbf/core/types.hpp"
#include "pbf/render/frame_block.hpp"

namespace pbf {

/// Depth of the nearest front of a sphere that reaches into the picture, at least the near plane's;
/// the far plane's if there is none [m]. There a length in the scene covers most pixels.
Real nearest_front(const PointsView& positions, Real radius, const FrameBlock& frame, int threads);

}  // namespace pbf
