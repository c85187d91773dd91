#pragma once

#include "pbf/gl/framebuffer.hpp"
#include "pbf/gl/program.hpp"
#include "pbf/render/frame_block.hpp"
#include "pbf/render/params.hpp"
#include "pbf/render/passes/sprites.hpp"

namespace pbf {

/// Far side of the farthest sphere at each pixel, exactly where the ray leaves it, as affine
/// depth. MIN blending takes the farthest. A pass for drivers that cannot find it with the front;
/// see SphereDepth.
class BackDepth {
 public:
  static constexpr float kNone = -kNothing;  ///< where there is no fluid

  explicit BackDepth(const GlslSource& source);
  /// @param out  r32f affine depth, cleared first
  void operator()(const Sprites& sprites, const RenderParams& params, const Framebuffer& out);

 private:
  ProgramVariants programs_;  // of spheres, of ellipsoids
};

}  // namespace pbf
