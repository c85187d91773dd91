#include "pbf/render/passes/depth_smooth.hpp"

#include "pbf/render/passes/sphere_depth.hpp"

namespace pbf {

DepthSmooth::DepthSmooth(const GlslSource& source)
    : program_(source,
               {.vertex = {"frame.glsl", "fluid_tiles.vert"},
                .fragment = {"frame.glsl", "smooth.glsl", "depth_smooth.frag"},
                .defines = {}}) {}

void DepthSmooth::operator()(const FluidTiles& tiles,
                             const Texture& depth,
                             const Texture& spheres,
                             const RenderParams& params,
                             const Framebuffer& between,
                             const Texture& between_texture,
                             const Framebuffer& out) const {
  program_.use();
  program_.set("u_values", 0);
  program_.set("u_empty", -1e29F);
  program_.set("u_gaussian", params.smoothing == Smoothing::gaussian ? 1 : 0);
  program_.set("u_radius", params.smoothing_radius_in_force());
  program_.set("u_range", params.smoothing_range_in_force());
  program_.set("u_spheres", 1);
  spheres.bind(1);
  depth.bind(0);
  between.clear(0, {kNothing, 0, 0, 0});
  program_.set("u_axis", 1, 0);
  tiles.draw();
  between_texture.bind(0);
  out.clear(0, {kNothing, 0, 0, 0});
  program_.set("u_axis", 0, 1);
  tiles.draw();
}

}  // namespace pbf
