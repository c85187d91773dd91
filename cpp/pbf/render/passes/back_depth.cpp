#include "pbf/render/passes/back_depth.hpp"

namespace pbf {

BackDepth::BackDepth(const GlslSource& source)
    : program_(source,
               {.vertex = {"frame.glsl", "sphere_outline.glsl", "sprite.vert"},
                .fragment = {"frame.glsl", "sphere_hit.glsl", "back_depth.frag"},
                .defines = {}}) {}

void BackDepth::operator()(const Sprites& sprites,
                           const RenderParams& params,
                           const Framebuffer& out) const {
  out.clear(0, {kNone, 0, 0, 0});
  program_.use();
  Sprites::set(program_, params);
  sprites.draw(Blend::min);
}

}  // namespace pbf
