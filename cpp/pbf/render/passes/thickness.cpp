#include "pbf/render/passes/thickness.hpp"

namespace pbf {

Thickness::Thickness(const GlslSource& source)
    : program_(source,
               {.vertex = {"frame.glsl", "sphere_outline.glsl", "sprite.vert"},
                .fragment = {"frame.glsl", "sphere_hit.glsl", "thickness.frag"},
                .defines = {}}) {}

void Thickness::operator()(const Sprites& sprites,
                           const RenderParams& params,
                           const Framebuffer& out) const {
  out.clear(0, {0, 0, 0, 0});
  program_.use();
  Sprites::set(program_, params);
  sprites.draw(Blend::add);
}

}  // namespace pbf
