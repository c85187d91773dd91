// A program may have the system's OpenGL headers before this library's: their names are macros.
#define GL_ONE 1
#define GL_TEXTURE_2D 0x0DE1
#define GL_RGBA8 0x8058
#define EGL_NONE 0x3038
#define EGL_EXTENSIONS 0x3055
#define glClear _glClear
#define glActiveTexture __glewActiveTexture
using GLenum = unsigned int;
using EGLDisplay = void*;

#include "pbf/render/fluid_renderer.hpp"

#include <doctest/doctest.h>

TEST_CASE("fluid_renderer: its header brings no name of OpenGL or EGL") {
  using namespace pbf;
  const GLenum same = GL_TEXTURE_2D;  // would be ambiguous beside pbf::GLenum
  const EGLDisplay none = nullptr;
  CHECK(same == 0x0DE1);
  CHECK(none == nullptr);
  CHECK(FluidRenderer(16, 16).width() == 16);
}
