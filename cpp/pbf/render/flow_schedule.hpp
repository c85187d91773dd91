#pragma once

#include "pbf/render/frame_block.hpp"
#include "pbf/render/layer_filter.hpp"

namespace pbf {

/// How curvature flow gets as far as a Gaussian of standard deviation radius/2 would: in time steps
/// of several stages each (glsl/curvature_flow.frag).
struct FlowSchedule {
  int steps;
  int stages;     ///< of a step
  Real variance;  ///< D T of a step [m²]
};

/// The steps of all iterations. @param nearest  depth of the nearest fluid [m]: its pixels are the
/// smallest in the scene and need most stages. There are no more than 24; with a kernel of which
/// each pixel sees more than some 40 pixels to a side, that is less smoothing than asked for there.
FlowSchedule flow_schedule(const LayerFilter& filter,
                           int iterations,
                           const FrameBlock& frame,
                           Real nearest);

}  // namespace pbf
