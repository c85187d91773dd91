#pragma once

#include "pbf/gl/framebuffer.hpp"
#include "pbf/gl/program.hpp"
#include "pbf/render/passes/fluid_tiles.hpp"

namespace pbf {

/// Normals in eye space from differences of the positions that smoothed depth stands for; exact on
/// a plane at any field of view, and at a silhouette from the side that belongs to the surface.
class Normal {
 public:
  explicit Normal(const GlslSource& source);
  /// @param depth  affine depth   @param out  rgba32f: unit normal, 0 where there is no fluid
  /// @param range  steps of depth higher than this are between surfaces, not of one [m]
  void operator()(const FluidTiles& tiles,
                  const Texture& depth,
                  Real range,
                  const Framebuffer& out) const;

 private:
  Program program_;
};

}  // namespace pbf
