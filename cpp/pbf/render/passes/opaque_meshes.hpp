#pragma once

#include "pbf/gl/buffer.hpp"
#include "pbf/gl/framebuffer.hpp"
#include "pbf/render/mesh.hpp"
#include "pbf/render/passes/environment.hpp"

namespace pbf {

/// What meshes are drawn into.
struct MeshTargets {
  /// @param color  srgb8, the picture
  explicit MeshTargets(const Texture& color);
  Texture light;  ///< linear
  Texture depth;  ///< affine
  Texture nearest;
  Framebuffer framebuffer;  ///< color, light and depth
};

/// Opaque things, lit by sky and sun, flat on each triangle; hidden below the floor.
class OpaqueMeshes {
 public:
  explicit OpaqueMeshes(GlslSource source);
  /// Draws over the picture; `to.light` and `to.depth` are cleared first.
  void operator()(const Meshes& meshes,
                  const Surroundings& surroundings,
                  const Camera& camera,
                  const RenderParams& params,
                  const MeshTargets& to);

 private:
  ProgramVariants program_;
  Buffer buffer_;
  VertexArray array_;
};

}  // namespace pbf
