#include "pbf/gl/egl_display.hpp"

#include "pbf/core/error.hpp"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <map>
#include <optional>
#include <string_view>

namespace pbf {
namespace {

struct Device {
  EGLDevice handle;
  int index;
  bool software;
};

std::string text_or(const char* text, const char* otherwise) {
  return text != nullptr && *text != '\0' ? text : otherwise;
}

/// All of them: Mesa leaves the software device out if asked for fewer than there are.
std::vector<Device> all_devices(std::vector<std::string>& notes) {
  EGLint count = 0;
  if (eglQueryDevicesEXT == nullptr || eglQueryDeviceStringEXT == nullptr) {
    notes.emplace_back("EGL devices: this EGL cannot list them (no EGL_EXT_device_enumeration)");
    return {};
  }
  if (eglQueryDevicesEXT(0, nullptr, &count) == 0 || count < 1) {
    notes.push_back("EGL devices: none found (" + egl_error_text() + ")");
    return {};
  }
  std::vector<EGLDevice> handles(static_cast<std::size_t>(count));
  eglQueryDevicesEXT(count, handles.data(), &count);
  std::vector<Device> devices;
  for (int k = 0; k < count; ++k) {
    const char* extensions = eglQueryDeviceStringEXT(handles[k], EGL_EXTENSIONS);
    devices.push_back({handles[k], k, has_extension(extensions, "EGL_MESA_device_software")});
  }
  return devices;
}

std::string device_name(const Device& device) {
  std::string name = "EGL device " + std::to_string(device.index);
  if (device.software) return name + " (software)";
  const char* extensions = eglQueryDeviceStringEXT(device.handle, EGL_EXTENSIONS);
  const char* file = has_extension(extensions, "EGL_EXT_device_drm")
                         ? eglQueryDeviceStringEXT(device.handle, EGL_DRM_DEVICE_FILE_EXT)
                         : nullptr;
  return name + " (" + text_or(file, text_or(extensions, "no extensions").c_str()) + ")";
}

std::optional<int> asked_device(const std::vector<Device>& devices) {
  const char* text = std::getenv("PBF_EGL_DEVICE");
  if (text == nullptr || *text == '\0') return std::nullopt;
  int index = -1;
  const auto [end, error] = std::from_chars(text, text + std::strlen(text), index);
  if (error != std::errc() || *end != '\0' || index < 0 ||
      index >= static_cast<int>(devices.size())) {
    std::string known;
    for (const Device& device : devices) known += "\n  " + device_name(device);
    throw RendererUnavailable(std::string("PBF_EGL_DEVICE = ") + text +
                              ": must be the index of an EGL device; there are " +
                              std::to_string(devices.size()) + known);
  }
  return index;
}

}  // namespace

bool has_extension(const char* list, const char* name) {
  std::string_view rest = list != nullptr ? list : "";
  while (!rest.empty()) {
    const auto end = std::min(rest.find(' '), rest.size());
    if (rest.substr(0, end) == name) return true;
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return false;
}

std::vector<EglPlatform> egl_platforms(std::vector<std::string>& notes) {
  load_egl_functions();
  std::vector<Device> devices = all_devices(notes);
  const std::optional<int> asked = asked_device(devices);
  std::stable_partition(devices.begin(), devices.end(),
                        [](const Device& d) { return !d.software; });
  std::vector<EglPlatform> platforms;
  for (const Device& device : devices) {
    if (!asked || device.index == *asked) {
      platforms.push_back({device_name(device), EGL_PLATFORM_DEVICE_EXT, device.handle});
    }
  }
  if (asked) return platforms;
  const char* client = eglQueryString(nullptr, EGL_EXTENSIONS);
  if (has_extension(client, "EGL_MESA_platform_surfaceless")) {
    platforms.push_back({"surfaceless", EGL_PLATFORM_SURFACELESS_MESA, nullptr});
  } else {
    notes.emplace_back("surfaceless: this EGL has no EGL_MESA_platform_surfaceless");
  }
  return platforms;
}

EGLDisplay open_display(const EglPlatform& platform) {
  static std::map<void*, EGLDisplay> opened;
  if (const auto found = opened.find(platform.native); found != opened.end()) return found->second;
  if (eglGetPlatformDisplayEXT == nullptr) return nullptr;
  EGLDisplay display = eglGetPlatformDisplayEXT(platform.platform, platform.native, nullptr);
  EGLint major = 0;
  EGLint minor = 0;
  if (display == nullptr || eglInitialize(display, &major, &minor) == 0) return nullptr;
  opened[platform.native] = display;
  return display;
}

std::string egl_error_text() {
  switch (const EGLint error = eglGetError()) {
    case EGL_SUCCESS:
      return "no error was given";
    case 0x3001:
      return "EGL_NOT_INITIALIZED: no driver for it could be started";
    case 0x3002:
      return "EGL_BAD_ACCESS: the context is current in another thread, or the device "
             "file may not be opened";
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
