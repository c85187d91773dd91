#pragma once

#include "pbf/gl/framebuffer.hpp"
#include "pbf/gl/program.hpp"
#include "pbf/render/frame_block.hpp"
#include "pbf/render/params.hpp"
#include "pbf/render/passes/sprites.hpp"

namespace pbf {

/// Front of the nearest sphere at each pixel, exactly where the viewing ray enters it, as affine
/// depth with the sphere's crowding (glsl/frame.glsl). MAX blending takes the nearest: without a
/// depth buffer that is a third faster in a software rasterizer than gl_FragDepth. Where each
/// target can blend in its own way (OpenGL 4.0) thickness and back depth come along in targets of
/// their own: hitting each sphere once is cheaper than three times.
class SphereDepth {
 public:
  explicit SphereDepth(const GlslSource& source, bool with_others);
  /// @param out  r32f affine depth, and if with_others r32f thickness [m] and r32f back depth; all
  /// are cleared first
  void operator()(const Sprites& sprites, const RenderParams& params, const Framebuffer& out);

 private:
  ProgramVariants programs_;  // of spheres, of ellipsoids
  bool with_others_;
};

}  // namespace pbf
