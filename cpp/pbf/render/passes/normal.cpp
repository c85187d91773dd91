#include "pbf/render/passes/normal.hpp"

#include "pbf/gl/draw.hpp"

namespace pbf {

Normal::Normal(const GlslSource& source)
    : program_(source,
               {.vertex = {"fullscreen.vert"},
                .fragment = {"frame.glsl", "normal.frag"},
                .defines = {}}) {}

void Normal::operator()(const Texture& depth, const Framebuffer& out) const {
  program_.use();
  program_.set("u_values", 0);
  depth.bind(0);
  out.bind();
  draw_fullscreen();
}

}  // namespace pbf
