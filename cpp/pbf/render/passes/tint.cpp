#include "pbf/render/passes/tint.hpp"

namespace pbf {

Tint::Tint(const GlslSource& source)
    : program_(source,
               {.vertex = {"frame.glsl", "sphere_outline.glsl", "color.glsl", "spheres.vert"},
                .fragment = {"frame.glsl", "sphere_hit.glsl", "tint.frag"},
                .defines = {}}) {
  (void)program_.with({"TINT", "POINTS"});  // an error in a shader shows now
}

void Tint::operator()(const ColoredParticles& particles,
                      const Texture& depth,
                      Real radius,
                      const Framebuffer& out) {
  depth.bind(0);
  out.clear(0, {0, 0, 0, 0});
  const Program& program = particles.choose(program_, {"TINT"});
  program.use();
  program.set("u_depth", 0);
  program.set("u_radius", radius);
  program.set("u_target_size",
              Vec3(static_cast<Real>(out.width()), static_cast<Real>(out.height()), 0));
  particles.draw(Blend::add);
}

}  // namespace pbf
