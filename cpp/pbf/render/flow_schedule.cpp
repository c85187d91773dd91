#include "pbf/render/flow_schedule.hpp"

#include <algorithm>

namespace pbf {
namespace {

// With fewer, a step of first order would damp the spheres' bumps by less than the Gaussian does.
constexpr int kStepsPerIteration = 3;
constexpr int kMostStages = 24;

}  // namespace

FlowSchedule flow_schedule(const LayerFilter& filter,
                           int iterations,
                           const FrameBlock& frame,
                           Real nearest) {
  const Real sigma = 0.5F * filter.radius;
  const Real variance = 0.5F * sigma * sigma / kStepsPerIteration;
  const auto [half_width, half_height, near, far] = frame.lens;
  const bool perspective = frame.size[2] > 0.5F;
  const Real scale = frame.size[3] / (perspective ? std::max(nearest, near) : 1);
  // The largest trace of M, at the picture's corners.
  const Real trace = 2 + (perspective ? half_width * half_width + half_height * half_height : 0);
  int stages = 1;
  while (stages < kMostStages && 0.45F * 0.5F * static_cast<Real>(stages * stages + stages) <
                                     variance * scale * scale * trace) {
    ++stages;
  }
  return {iterations * kStepsPerIteration, stages, variance};
}

}  // namespace pbf
