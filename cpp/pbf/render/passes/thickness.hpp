#pragma once

#include "pbf/gl/framebuffer.hpp"
#include "pbf/gl/program.hpp"
#include "pbf/render/params.hpp"
#include "pbf/render/passes/sprites.hpp"

namespace pbf {

/// Length of fluid along each pixel's ray [m]: every sprite adds chord · V / (4/3 π R³). Summed
/// over the pixels of a parallel view that is the fluid's volume, whatever the sprites' radius. The
/// pass for drivers that cannot add it while they find the depth; see SphereDepth.
class Thickness {
 public:
  explicit Thickness(const GlslSource& source);
  /// @param out  r32f [m], cleared first
  void operator()(const Sprites& sprites, const RenderParams& params, const Framebuffer& out);

 private:
  ProgramVariants programs_;  // of spheres, of ellipsoids
};

}  // namespace pbf
