#include "pbf/render/passes/thickness.hpp"

namespace pbf {

Thickness::Thickness(const GlslSource& source)
    : programs_(source,
                {.vertex = {"frame.glsl", "sphere_outline.glsl", "sprite.vert"},
                 .fragment = {"frame.glsl", "sphere_hit.glsl", "sprite_hit.glsl", "thickness.frag"},
                 .defines = {}}) {
  (void)programs_.with({});  // an error in a shader shows now
}

void Thickness::operator()(const Sprites& sprites,
                           const RenderParams& params,
                           const Framebuffer& out) {
  out.clear(0, {0, 0, 0, 0});
  const Program& program = programs_.with(sprites.defines());
  program.use();
  Sprites::set(program, params);
  sprites.draw(Blend::add);
}

}  // namespace pbf
