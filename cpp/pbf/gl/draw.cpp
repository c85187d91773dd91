#include "pbf/gl/draw.hpp"

#include "pbf/gl/functions.hpp"

namespace pbf {

void set_draw_state(Blend blend) {
  if (blend == Blend::nearest) {
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GREATER);
  } else {
    glDisable(GL_DEPTH_TEST);
  }
  glEnable(GL_CULL_FACE);
  glCullFace(GL_BACK);
  glEnable(GL_FRAMEBUFFER_SRGB);
  if (blend == Blend::replace || blend == Blend::nearest) {
    glDisable(GL_BLEND);
    return;
  }
  glEnable(GL_BLEND);
  glBlendEquation(blend == Blend::max ? GL_MAX : blend == Blend::min ? GL_MIN : GL_FUNC_ADD);
  if (blend == Blend::max_add_min) {
    glBlendEquationi(0, GL_MAX);
    glBlendEquationi(2, GL_MIN);
  }
  if (blend == Blend::over) {
    glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  } else {
    glBlendFunc(GL_ONE, GL_ONE);
  }
}

void draw_fullscreen() {
  set_draw_state(Blend::replace);
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace pbf
