#pragma once

#include "pbf/render/frame_block.hpp"
#include "pbf/render/params.hpp"

namespace pbf {

/// How a layer is smoothed: RenderParams, read for one of the two layers. For the passes in GLSL
/// and for those in C++.
struct LayerFilter {
  enum class Layer { depth, far_side, thickness };
  Layer layer;
  Smoothing kind;
  Real radius;  ///< where the kernel ends [m]
  Real range;   ///< [m]
  Real behind;  ///< how far behind a pixel narrow_range puts what is behind its window [m]
  bool close_gaps = false;  ///< the last pass, over what thinning out wide kernels has left
};

LayerFilter depth_filter(const RenderParams& params);
LayerFilter thickness_filter(const RenderParams& params);
/// Of the far side's affine depth: run once. What ends before a pixel's front begins is another
/// body's, and does not count there.
LayerFilter back_filter(const RenderParams& params);

/// More neighbors to a side than this are thinned out evenly.
inline constexpr int kMostTaps = 24;

/// Whether any kernel is that wide, so that a last pass with close_gaps is due.
/// @param nearest  depth of the nearest fluid [m]
bool leaves_gaps(const LayerFilter& filter, const FrameBlock& frame, Real nearest);

/// Calls once(filter) for each iteration, and a last time to close the gaps if they leave any.
template <class F>
void iterate(
    const LayerFilter& filter, int iterations, const FrameBlock& frame, Real nearest, F&& once) {
  for (int k = 0; k < iterations; ++k) once(filter);
  if (iterations == 0 || !leaves_gaps(filter, frame, nearest)) return;
  LayerFilter closing = filter;
  closing.close_gaps = true;
  once(closing);
}

}  // namespace pbf
