#include "pbf/render/passes/back_depth.hpp"

namespace pbf {

BackDepth::BackDepth(const GlslSource& source)
    : programs_(
          source,
          {.vertex = {"frame.glsl", "sphere_outline.glsl", "sprite.vert"},
           .fragment = {"frame.glsl", "sphere_hit.glsl", "sprite_hit.glsl", "back_depth.frag"},
           .defines = {}}) {
  (void)programs_.with({});  // an error in a shader shows now
}

void BackDepth::operator()(const Sprites& sprites,
                           const RenderParams& params,
                           const Framebuffer& out) {
  out.clear(0, {kNone, 0, 0, 0});
  const Program& program = programs_.with(sprites.defines());
  program.use();
  Sprites::set(program, params);
  sprites.draw(Blend::min);
}

}  // namespace pbf
