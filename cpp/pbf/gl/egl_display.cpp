#include "pbf/gl/egl_display.hpp"

#include "pbf/core/error.hpp"

#include <algorithm>
#include <string_view>

namespace pbf {

bool has_extension(const char* list, const char* name) {
  std::string_view rest = list != nullptr ? list : "";
  while (!rest.empty()) {
    const auto end = std::min(rest.find(' '), rest.size());
    if (rest.substr(0, end) == name) return true;
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return false;
}

std::vector<EglPlatform> egl_platforms(const DeviceWish& wish, std::vector<std::string>& notes) {
  using Kind = DeviceWish::Kind;
  const std::vector<EglDevice> devices = egl_devices(notes);
  std::vector<EglPlatform> platforms;
  for (const EglDevice& device : ranked(devices, wish)) {
    platforms.push_back({device.name, EGL_PLATFORM_DEVICE_EXT, device});
  }
  if (wish.kind == Kind::any || wish.kind == Kind::surfaceless) {
    const char* client = eglQueryString(nullptr, EGL_EXTENSIONS);
    if (has_extension(client, "EGL_MESA_platform_surfaceless")) {
      platforms.push_back({"surfaceless", EGL_PLATFORM_SURFACELESS_MESA, {}});
    } else {
      notes.emplace_back("surfaceless: this EGL has no EGL_MESA_platform_surfaceless");
    }
  } else if (platforms.empty()) {
    std::string known;
    for (const EglDevice& device : devices) known += "\n  " + device.name;
    for (const std::string& note : notes) known += "\n  " + note;
    throw RendererUnavailable(wish.source + ": there is no such device; there are " +
                              std::to_string(devices.size()) + ":" + known);
  }
  return platforms;
}

EGLDisplay open_display(const EglPlatform& platform) {
  if (eglGetPlatformDisplayEXT == nullptr) return nullptr;
  EGLDisplay display = eglGetPlatformDisplayEXT(platform.platform, platform.device.handle, nullptr);
  // Each time: it does nothing unless somebody else has terminated the display in between.
  EGLint major = 0;
  EGLint minor = 0;
  if (display == nullptr || eglInitialize(display, &major, &minor) == 0) return nullptr;
  return display;
}

std::string egl_error_text() {
  switch (const EGLint error = eglGetError()) {
    case EGL_SUCCESS:
      return "no error was given";
    case 0x3001:
      return "EGL_NOT_INITIALIZED: no driver for it could be started";
    case 0x3002:
      return "EGL_BAD_ACCESS: the context is current in another thread, this thread has one of "
             "GLX, "
             "or the device file may not be opened";
    case 0x3003:
      return "EGL_BAD_ALLOC: out of memory or of contexts";
    case 0x3004:
      return "EGL_BAD_ATTRIBUTE: an attribute is unknown to this EGL";
    case 0x3005:
      return "EGL_BAD_CONFIG: no such framebuffer configuration";
    case 0x3006:
      return "EGL_BAD_CONTEXT: no such context";
    case 0x3008:
      return "EGL_BAD_DISPLAY: no such display";
    case 0x3009:
      return "EGL_BAD_MATCH: this OpenGL version or configuration is not offered";
    case 0x300C:
      return "EGL_BAD_PARAMETER: a parameter is invalid";
    case 0x300D:
      return "EGL_BAD_SURFACE: no such surface";
    case 0x300E:
      return "EGL_CONTEXT_LOST: the device was reset";
    default:
      return "EGL error " + std::to_string(error);
  }
}

}  // namespace pbf
