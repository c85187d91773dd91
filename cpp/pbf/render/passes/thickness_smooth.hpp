#pragma once

#include "pbf/gl/framebuffer.hpp"
#include "pbf/gl/program.hpp"
#include "pbf/render/params.hpp"
#include "pbf/render/passes/fluid_tiles.hpp"

namespace pbf {

/// Smooths thickness as DepthSmooth does depth; the depth says how many pixels the kernel's radius
/// is. Pixels without fluid carry no weight.
class ThicknessSmooth {
 public:
  explicit ThicknessSmooth(const GlslSource& source);
  /// One iteration. @param between, out  r32f targets; `between_texture` is what `between` draws
  /// into.
  void operator()(const FluidTiles& tiles,
                  const Texture& thickness,
                  const Texture& depth,
                  const RenderParams& params,
                  const Framebuffer& between,
                  const Texture& between_texture,
                  const Framebuffer& out) const;

 private:
  Program program_;
};

}  // namespace pbf
