#include "pbf/gl/error.hpp"

#include "pbf/core/error.hpp"
#include "pbf/gl/functions.hpp"

#include <new>
#include <string>

namespace pbf {

void require_no_gl_error() {
  const GLenum error = glGetError();
  if (error == GL_NO_ERROR) return;
  // A driver may have one for each of its parts.
  for (int k = 0; k < 8 && glGetError() != GL_NO_ERROR; ++k) continue;
  if (error == GL_OUT_OF_MEMORY) throw std::bad_alloc();
  throw GlError("the driver reports OpenGL error " + std::to_string(error));
}

}  // namespace pbf
