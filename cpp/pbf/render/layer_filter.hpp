#pragma once

#include "pbf/render/params.hpp"

namespace pbf {

/// How a layer is smoothed: RenderParams, read for one of the two layers. For the passes in GLSL
/// and for those in C++.
struct LayerFilter {
  enum class Layer { depth, thickness };
  Layer layer;
  Smoothing kind;
  Real radius;  ///< where the kernel ends [m]
  Real range;   ///< [m]
  Real behind;  ///< how far behind a pixel narrow_range puts what is behind its window [m]
};

LayerFilter depth_filter(const RenderParams& params);
LayerFilter thickness_filter(const RenderParams& params);

}  // namespace pbf
