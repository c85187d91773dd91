#include "pbf/render/passes/sphere_depth.hpp"

namespace pbf {

SphereDepth::SphereDepth(const GlslSource& source, bool with_thickness)
    : program_(source,
               {.vertex = {"frame.glsl", "sphere_outline.glsl", "sprite.vert"},
                .fragment = {"frame.glsl", "sphere_hit.glsl", "sphere_depth.frag"},
                .defines = with_thickness ? std::vector<std::string>{"THICKNESS"}
                                          : std::vector<std::string>{}}),
      with_thickness_(with_thickness) {}

void SphereDepth::operator()(const Sprites& sprites,
                             const RenderParams& params,
                             const Framebuffer& out) const {
  out.clear(0, {kNothing, 0, 0, 0});
  if (with_thickness_) out.clear(1, {0, 0, 0, 0});
  program_.use();
  Sprites::set(program_, params);
  sprites.draw(with_thickness_ ? Blend::max_and_add : Blend::max);
}

}  // namespace pbf
