#pragma once

#include "pbf/gl/framebuffer.hpp"
#include "pbf/gl/program.hpp"
#include "pbf/render/layer_filter.hpp"
#include "pbf/render/passes/fluid_tiles.hpp"

namespace pbf {

/// Smooths a layer by a separable filter: along the rows, then along the columns, by local
/// straight-line fits (glsl/smooth.frag). The kernel's radius is a length in the scene. In depth
/// single spheres vanish so, and drops stay as round as they are; in thickness pixels without fluid
/// carry no weight.
class Smooth {
 public:
  explicit Smooth(const GlslSource& source);
  /// One iteration. @param values   affine depth, or thickness [m]
  /// @param spheres  affine depth with crowding, of SphereDepth
  /// @param between, out  r32f targets; `between_texture` is what `between` draws into.
  void operator()(const LayerFilter& filter,
                  const FluidTiles& tiles,
                  const Texture& values,
                  const Texture& spheres,
                  const Framebuffer& between,
                  const Texture& between_texture,
                  const Framebuffer& out) const;

 private:
  // A program each: a software rasterizer works off every branch of a shader.
  Program bilateral_, gaussian_, narrow_range_;
};

}  // namespace pbf
