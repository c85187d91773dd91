#include "pbf/gl/functions.hpp"

#include "pbf/core/error.hpp"

#include <dlfcn.h>
#include <string>

namespace pbf {

// NOLINTBEGIN(readability-identifier-naming)
#define PBF_DEFINE(result, name, arguments) result(*name) arguments = nullptr;
#define PBF_EGL PBF_DEFINE
#define PBF_EGL_OPTIONAL PBF_DEFINE
#define PBF_GL PBF_DEFINE
#define PBF_GL_OPTIONAL PBF_DEFINE
#include "pbf/gl/functions.inl"
#undef PBF_EGL
#undef PBF_EGL_OPTIONAL
#undef PBF_GL
#undef PBF_GL_OPTIONAL
#undef PBF_DEFINE
// NOLINTEND(readability-identifier-naming)

namespace {

void* open_library() {
  std::string attempts;
  for (const char* name : {"libEGL.so.1", "libEGL.so"}) {
    // Never closed: drivers start threads and leave handlers behind.
    if (void* library = dlopen(name, RTLD_NOW | RTLD_LOCAL)) return library;
    attempts += std::string("\n  ") + dlerror();
  }
  throw RendererUnavailable(
      "rendering needs EGL, and its library cannot be opened:" + attempts +
      "\nCure: apt-get install libegl1 libgl1-mesa-dri (Debian, Ubuntu); dnf install mesa-libEGL "
      "mesa-dri-drivers (Fedora)");
}

template <class F>
void find(F*& function, AnyFunction address) {
  function = reinterpret_cast<F*>(address);
}

void require(bool found, const char* name) {
  if (!found) throw RendererUnavailable(std::string("the graphics driver has no ") + name);
}

}  // namespace

void load_egl_functions() {
  static void* library = nullptr;
  if (library != nullptr) return;
  void* opened = open_library();
#define PBF_EGL(result, name, arguments)                           \
  find(name, reinterpret_cast<AnyFunction>(dlsym(opened, #name))); \
  require(name != nullptr, #name);
#define PBF_EGL_OPTIONAL(result, name, arguments) find(name, eglGetProcAddress(#name));
#include "pbf/gl/functions.inl"
#undef PBF_EGL
#undef PBF_EGL_OPTIONAL
  library = opened;
}

void load_gl_functions() {
  static bool loaded = false;
  if (loaded) return;
#define PBF_GL(result, name, arguments) \
  find(name, eglGetProcAddress(#name)); \
  require(name != nullptr, #name);
#define PBF_GL_OPTIONAL(result, name, arguments) find(name, eglGetProcAddress(#name));
#include "pbf/gl/functions.inl"
#undef PBF_GL
#undef PBF_GL_OPTIONAL
  loaded = true;
}

}  // namespace pbf
