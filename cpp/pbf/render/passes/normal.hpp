#pragma once

#include "pbf/gl/framebuffer.hpp"
#include "pbf/gl/program.hpp"
#include "pbf/render/params.hpp"
#include "pbf/render/passes/fluid_tiles.hpp"

namespace pbf {

/// Normals in eye space from differences of the positions that smoothed depth stands for; exact on
/// a plane at any field of view, and at a silhouette from the side that belongs to the surface. At
/// the outline of a drop those of its sphere.
class Normal {
 public:
  explicit Normal(const GlslSource& source);
  /// @param depth    affine depth
  /// @param spheres  that of the spheres, with their crowding
  /// @param out      rgba32f: unit normal, 0 where there is no fluid
  void operator()(const FluidTiles& tiles,
                  const Texture& depth,
                  const Texture& spheres,
                  const RenderParams& params,
                  const Framebuffer& out) const;

 private:
  Program program_;
};

}  // namespace pbf
