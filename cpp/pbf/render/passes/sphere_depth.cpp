#include "pbf/render/passes/sphere_depth.hpp"

#include "pbf/render/passes/back_depth.hpp"

namespace pbf {

SphereDepth::SphereDepth(const GlslSource& source, bool with_others)
    : programs_(
          source,
          {.vertex = {"frame.glsl", "sphere_outline.glsl", "sprite.vert"},
           .fragment = {"frame.glsl", "sphere_hit.glsl", "sprite_hit.glsl", "sphere_depth.frag"},
           .defines = with_others ? std::vector<std::string>{"ALL"} : std::vector<std::string>{}}),
      with_others_(with_others) {
  (void)programs_.with({});  // an error in a shader shows now
}

void SphereDepth::operator()(const Sprites& sprites,
                             const RenderParams& params,
                             const Framebuffer& out) {
  out.clear(0, {kNothing, 0, 0, 0});
  if (with_others_) {
    out.clear(1, {0, 0, 0, 0});
    out.clear(2, {BackDepth::kNone, 0, 0, 0});
  }
  const Program& program = programs_.with(sprites.defines());
  program.use();
  Sprites::set(program, params);
  sprites.draw(with_others_ ? Blend::max_add_min : Blend::max);
}

}  // namespace pbf
