#include "pbf/render/passes/resolve.hpp"

#include "pbf/gl/draw.hpp"

namespace pbf {

Resolve::Resolve(const GlslSource& source)
    : program_(source,
               {.vertex = {"fullscreen.vert"}, .fragment = {"resolve.frag"}, .defines = {}}) {}

void Resolve::operator()(const Texture& color, int factor, const Framebuffer& out) const {
  out.bind();
  color.bind(0);
  program_.use();
  program_.set("u_color", 0);
  program_.set("u_factor", factor);
  no_vertices_.bind();
  draw_fullscreen();
}

}  // namespace pbf
