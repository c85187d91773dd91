#pragma once

#include "pbf/gl/framebuffer.hpp"
#include "pbf/gl/program.hpp"
#include "pbf/render/params.hpp"
#include "pbf/render/passes/fluid_tiles.hpp"

namespace pbf {

/// Smooths affine depth so that single spheres vanish: along the rows, then along the columns, by
/// local straight-line fits (glsl/smooth.glsl). The kernel's radius is a length in the scene.
class DepthSmooth {
 public:
  explicit DepthSmooth(const GlslSource& source);
  /// One iteration. @param spheres  affine depth with crowding, of SphereDepth
  /// @param between, out  r32f targets; `between_texture` is what `between` draws
  /// into.
  void operator()(const FluidTiles& tiles,
                  const Texture& depth,
                  const Texture& spheres,
                  const RenderParams& params,
                  const Framebuffer& between,
                  const Texture& between_texture,
                  const Framebuffer& out) const;

 private:
  Program program_;
};

}  // namespace pbf
