#include "pbf/render/passes/tint.hpp"

namespace pbf {

Tint::Tint(const GlslSource& source)
    : program_(source,
               {.vertex = {"frame.glsl", "sphere_outline.glsl", "color.glsl", "spheres.vert"},
                .fragment = {"frame.glsl", "sphere_hit.glsl", "tint.frag"},
                .defines = {"LINEAR"}}) {}

void Tint::operator()(const ColoredParticles& particles,
                      const Texture& depth,
                      Real radius,
                      const Framebuffer& out) const {
  depth.bind(0);
  out.clear(0, {0, 0, 0, 0});
  program_.use();
  program_.set("u_depth", 0);
  program_.set("u_radius", radius);
  program_.set("u_tint_size",
               Vec3(static_cast<Real>(out.width()), static_cast<Real>(out.height()), 0));
  particles.draw(Blend::add);
}

}  // namespace pbf
