#pragma once

#include "pbf/gl/program.hpp"
#include "pbf/render/flow_schedule.hpp"
#include "pbf/render/passes/fluid_tiles.hpp"
#include "pbf/render/target.hpp"

#include <array>

namespace pbf {

/// Smooths depth by moving the surface along its normal by its mean curvature [vdL09]
/// (glsl/curvature_flow.frag): bumps flow away, and the faster the smaller they are. Drops stay as
/// they are.
class CurvatureFlow {
 public:
  explicit CurvatureFlow(const GlslSource& source);
  /// @param depth    affine depth   @param spheres  the same, with crowding
  /// @param targets  r32f, are written; the last stage's is the first of them
  void operator()(const LayerFilter& filter,
                  const FlowSchedule& schedule,
                  const FluidTiles& tiles,
                  const Texture& depth,
                  const Texture& spheres,
                  const std::array<const Target*, 3>& targets) const;

 private:
  Program program_;
};

}  // namespace pbf
