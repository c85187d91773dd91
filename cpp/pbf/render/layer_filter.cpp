#include "pbf/render/layer_filter.hpp"

#include <algorithm>

namespace pbf {

LayerFilter depth_filter(const RenderParams& params) {
  const Real range = params.smoothing_range_in_force();
  return {.layer = LayerFilter::Layer::depth,
          .kind = params.smoothing,
          .radius = params.smoothing_radius_in_force(),
          .range = range,
          .behind = std::min(params.radius, range)};
}

LayerFilter back_filter(const RenderParams& params) {
  LayerFilter filter = depth_filter(params);
  filter.layer = LayerFilter::Layer::far_side;
  filter.kind = Smoothing::gaussian;
  return filter;
}

LayerFilter thickness_filter(const RenderParams& params) {
  return {.layer = LayerFilter::Layer::thickness,
          .kind = params.thickness_smoothing == ThicknessSmoothing::gaussian ? Smoothing::gaussian
                                                                             : Smoothing::bilateral,
          .radius = params.thickness_radius_in_force(),
          .range = params.thickness_range_in_force(),
          .behind = 0};
}

bool leaves_gaps(const LayerFilter& filter, const FrameBlock& frame, Real nearest) {
  const bool perspective = frame.size[2] > 0.5F;
  const Real scale = frame.size[3] / (perspective ? std::max(nearest, frame.lens[2]) : 1);
  return filter.radius * scale > static_cast<Real>(kMostTaps);
}

}  // namespace pbf
