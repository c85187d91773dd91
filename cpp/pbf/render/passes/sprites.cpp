#include "pbf/render/passes/sprites.hpp"

namespace pbf {

void Sprites::upload(const PointsView& positions) {
  count_ = static_cast<GLsizei>(positions.cols());
  buffer_.upload(positions.data(), static_cast<GLsizeiptr>(positions.size() * sizeof(Real)));
}

void Sprites::draw(Blend blend) const {
  set_draw_state(blend);
  array_.bind();
  if (count_ > 0) glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, count_);
}

}  // namespace pbf
