#include "pbf/render/passes/sprites.hpp"

namespace pbf {

Sprites::Sprites() : buffer_(GL_ARRAY_BUFFER), stretches_(GL_ARRAY_BUFFER) {
  spheres_.instances(buffer_, 4, 0);
  ellipsoids_.instances(buffer_, 4, 0);
  ellipsoids_.instances(stretches_, 4, 1, 0, 2);
  ellipsoids_.instances(stretches_, 4, 2, 1, 2);
}

void Sprites::upload(const Records& particles, const Records& stretches) {
  count_ = static_cast<GLsizei>(particles.size());
  buffer_.upload(particles.data(), count_ * static_cast<GLsizeiptr>(sizeof(Record)));
  stretched_ = stretches.size() > 0;
  if (stretched_) {
    stretches_.upload(stretches.data(), 2 * count_ * static_cast<GLsizeiptr>(sizeof(Record)));
  }
}

std::vector<std::string> Sprites::defines() const {
  return stretched_ ? std::vector<std::string>{"ELLIPSOIDS"} : std::vector<std::string>{};
}

void Sprites::set(const Program& program, const RenderParams& params) {
  program.set("u_radius", params.radius);
  program.set("u_drop_radius", params.drop_radius_in_force());
  program.set("u_volume", params.volume_in_force());
}

void Sprites::draw(Blend blend) const {
  set_draw_state(blend);
  (stretched_ ? ellipsoids_ : spheres_).bind();
  if (count_ > 0) glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, count_);
}

}  // namespace pbf
