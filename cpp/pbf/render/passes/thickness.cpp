#include "pbf/render/passes/thickness.hpp"

#include "pbf/render/passes/sphere_depth.hpp"

namespace pbf {

Thickness::Thickness(const GlslSource& source)
    : program_(source,
               {.vertex = {"frame.glsl", "sprite.vert"},
                .fragment = {"frame.glsl", "sphere_hit.glsl", "thickness.frag"},
                .defines = {}}) {}

void Thickness::operator()(const Sprites& sprites,
                           const RenderParams& params,
                           const Framebuffer& out) const {
  out.clear(0, {0, 0, 0, 0});
  program_.use();
  program_.set("u_radius", params.radius);
  program_.set("u_volume_share", volume_share(params));
  sprites.draw(Blend::add);
}

}  // namespace pbf
