#pragma once

namespace pbf {

/// How what is drawn joins what is there.
enum class Blend {
  replace,
  max,          ///< the larger value stays
  add,          ///< the sum
  min,          ///< the smaller value stays
  max_add_min,  ///< one for each of three targets; OpenGL 4.0
  over,         ///< by the alpha of what is drawn, whose color has been multiplied by it
  nearest,      ///< what is drawn with the greater depth replaces; needs a depth buffer
};

/// Sets all of the state that drawing depends on here: blending, back faces culled, sRGB
/// encoding where a target has it, and a depth test for Blend::nearest alone.
void set_draw_state(Blend blend);

/// Three vertices, of which glsl/fullscreen.vert makes a triangle that covers the target; replaces
/// it.
void draw_fullscreen();

}  // namespace pbf
