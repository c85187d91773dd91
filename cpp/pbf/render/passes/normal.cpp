#include "pbf/render/passes/normal.hpp"

namespace pbf {

Normal::Normal(const GlslSource& source)
    : program_(source,
               {.vertex = {"frame.glsl", "fluid_tiles.vert"},
                .fragment = {"frame.glsl", "normal.frag"},
                .defines = {}}) {}

void Normal::operator()(const FluidTiles& tiles,
                        const Texture& depth,
                        const Texture& spheres,
                        const RenderParams& params,
                        const Framebuffer& out) const {
  program_.use();
  program_.set("u_values", 0);
  program_.set("u_spheres", 1);
  program_.set("u_range", params.smoothing_range_in_force());
  program_.set("u_radius", params.radius);
  program_.set("u_drop_radius", params.drop_radius_in_force());
  depth.bind(0);
  spheres.bind(1);
  out.clear(0, {0, 0, 0, 0});
  tiles.draw();
}

}  // namespace pbf
