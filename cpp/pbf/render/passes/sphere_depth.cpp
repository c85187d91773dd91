#include "pbf/render/passes/sphere_depth.hpp"

#include <numbers>

namespace pbf {

float volume_share(const RenderParams& params) {
  const double R = params.radius;
  const double sphere = 4.0 / 3.0 * std::numbers::pi * R * R * R;
  return static_cast<float>(params.particle_volume.value_or(static_cast<Real>(sphere)) / sphere);
}

SphereDepth::SphereDepth(const GlslSource& source, bool with_thickness)
    : program_(source,
               {.vertex = {"frame.glsl", "sprite.vert"},
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
  program_.set("u_radius", params.radius);
  if (with_thickness_) program_.set("u_volume_share", volume_share(params));
  sprites.draw(with_thickness_ ? Blend::max_and_add : Blend::max);
}

}  // namespace pbf
