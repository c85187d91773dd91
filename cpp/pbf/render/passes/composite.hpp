#pragma once

#include "pbf/gl/framebuffer.hpp"
#include "pbf/gl/program.hpp"
#include "pbf/render/camera.hpp"
#include "pbf/render/params.hpp"
#include "pbf/render/passes/backdrop.hpp"
#include "pbf/render/passes/fluid_tiles.hpp"
#include "pbf/render/passes/opaque_meshes.hpp"

namespace pbf {

/// What composite draws from: smoothed affine depth, smoothed thickness [m], normal in eye space.
struct Surface {
  const FluidTiles& tiles;
  const Texture& depth;
  const Texture& thickness;
  const Texture& back;     ///< smoothed affine depth of the far side
  const Texture& normal;   ///< for spheres with their color
  const Texture& spheres;  ///< affine depth with crowding, not smoothed
  const Texture* tint;     ///< color of the fluid (passes/tint.hpp), null for its own
};

/// The picture: sky, floor, meshes and fluid. At the fluid's surface light is mirrored and bent
/// (Fresnel, Snell); what comes through is absorbed along its way (Beer-Lambert). The tank's edges
/// are drawn over it, or seen through the fluid. Spheres are opaque and lit by sun and sky.
class Composite {
 public:
  explicit Composite(const GlslSource& source);
  /// @param out     srgb8, multiplied by alpha
  /// @param meshes  targets of `out` for the meshes, none if there are none
  void operator()(const Surface& surface,
                  const Surroundings& surroundings,
                  const Camera& camera,
                  const RenderParams& params,
                  const Framebuffer& out,
                  const MeshTargets* meshes = nullptr);
  /// To be called when the environment map becomes another.
  void forget_backdrop() { backdrop_.forget(); }

 private:
  Backdrop backdrop_;
  ProgramVariants fluid_, spheres_;
  ProgramVariants tank_edges_;
  OpaqueMeshes opaque_meshes_;
  VertexArray no_vertices_;
};

}  // namespace pbf
