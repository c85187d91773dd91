#include "pbf/render/passes/sprites.hpp"

namespace pbf {

void Sprites::upload(const Records& particles) {
  count_ = static_cast<GLsizei>(particles.size());
  buffer_.upload(particles.data(), count_ * static_cast<GLsizeiptr>(sizeof(Record)));
}

void Sprites::set(const Program& program, const RenderParams& params) {
  program.set("u_radius", params.radius);
  program.set("u_drop_radius", params.drop_radius_in_force());
  program.set("u_volume", params.volume_in_force());
}

void Sprites::draw(Blend blend) const {
  set_draw_state(blend);
  array_.bind();
  if (count_ > 0) glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, count_);
}

}  // namespace pbf
