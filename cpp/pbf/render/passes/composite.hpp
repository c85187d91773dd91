#pragma once

#include "pbf/gl/framebuffer.hpp"
#include "pbf/gl/program.hpp"
#include "pbf/render/camera.hpp"
#include "pbf/render/params.hpp"
#include "pbf/render/passes/fluid_tiles.hpp"
#include "pbf/render/sun_shadow.hpp"

namespace pbf {

/// What composite draws from: smoothed affine depth, smoothed thickness [m], normal in eye space.
struct Surface {
  const FluidTiles& tiles;
  const Texture& depth;
  const Texture& thickness;
  const Texture& normal;  ///< for spheres with their color
  const Texture* tint;    ///< color of the fluid (passes/tint.hpp), null for its own
};

/// What stands around it.
struct Surroundings {
  const SunShadow& shadow;
};

/// The picture: sky, floor and fluid. At the fluid's surface light is mirrored and bent (Fresnel,
/// Snell); what comes through is absorbed along the thickness (Beer-Lambert). The tank's edges are
/// drawn over it, or seen through the fluid. Spheres are opaque and lit by sun and sky.
class Composite {
 public:
  explicit Composite(const GlslSource& source);
  /// @param out  srgb8, multiplied by alpha
  void operator()(const Surface& surface,
                  const Surroundings& surroundings,
                  const Camera& camera,
                  const RenderParams& params,
                  const Framebuffer& out);

 private:
  ProgramVariants background_;
  ProgramVariants fluid_, spheres_;
  Program tank_edges_;
  VertexArray no_vertices_;
};

}  // namespace pbf
