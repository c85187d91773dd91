#include "pbf/render/passes/normal.hpp"

namespace pbf {

Normal::Normal(const GlslSource& source)
    : program_(source,
               {.vertex = {"frame.glsl", "fluid_tiles.vert"},
                .fragment = {"frame.glsl", "normal.frag"},
                .defines = {}}) {}

void Normal::operator()(const FluidTiles& tiles,
                        const Texture& depth,
                        Real range,
                        const Framebuffer& out) const {
  program_.use();
  program_.set("u_values", 0);
  program_.set("u_range", range);
  depth.bind(0);
  out.clear(0, {0, 0, 0, 0});
  tiles.draw();
}

}  // namespace pbf
