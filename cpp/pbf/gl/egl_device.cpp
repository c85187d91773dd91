#include "pbf/gl/egl_device.hpp"

#include "pbf/core/error.hpp"
#include "pbf/gl/egl_display.hpp"
#include "pbf/gl/functions.hpp"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <limits>
#include <tuple>

namespace pbf {
namespace {

std::optional<int> natural_number(const std::string& text) {
  int number = -1;
  const char* last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), last, number);
  if (error != std::errc() || end != last || number < 0) return std::nullopt;
  return number;
}

std::string string_of(EGLDevice device, EGLint name) {
  const char* text = eglQueryDeviceStringEXT(device, name);
  return text != nullptr ? text : "";
}

EglDevice described(EGLDevice handle, int index) {
  EglDevice device{.handle = handle, .index = index};
  const std::string extensions = string_of(handle, EGL_EXTENSIONS);
  const auto has = [&](const char* name) { return has_extension(extensions.c_str(), name); };
  device.software = has("EGL_MESA_device_software");
  EGLAttrib cuda = -1;
  if (has("EGL_NV_device_cuda") && eglQueryDeviceAttribEXT != nullptr &&
      eglQueryDeviceAttribEXT(handle, EGL_CUDA_DEVICE_NV, &cuda) != 0 && cuda >= 0) {
    device.cuda = static_cast<int>(cuda);
  }
  // The file that drawing opens; the other one is the display's, and often another user's.
  if (has("EGL_EXT_device_drm_render_node")) {
    device.file = string_of(handle, EGL_DRM_RENDER_NODE_FILE_EXT);
  }
  if (device.file.empty() && has("EGL_EXT_device_drm")) {
    device.file = string_of(handle, EGL_DRM_DEVICE_FILE_EXT);
  }
  std::string what = device.software ? "software" : device.file;
  if (what.empty()) what = extensions.empty() ? "hardware" : extensions;
  if (device.cuda) what += ", CUDA " + std::to_string(*device.cuda);
  device.name = "EGL device " + std::to_string(index) + " (" + what + ")";
  return device;
}

bool allows(const DeviceWish& wish, const EglDevice& device) {
  switch (wish.kind) {
    case DeviceWish::Kind::any:
      return true;
    case DeviceWish::Kind::hardware:
      return !device.software;
    case DeviceWish::Kind::software:
      return device.software;
    case DeviceWish::Kind::surfaceless:
      return false;
    case DeviceWish::Kind::index:
      return device.index == wish.number;
    case DeviceWish::Kind::cuda:
      return device.cuda == wish.number;
  }
  return false;
}

}  // namespace

DeviceWish device_wish(const std::string& text) {
  using Kind = DeviceWish::Kind;
  std::string wanted = text;
  std::string source = "device = " + text;
  if (wanted.empty()) {
    const char* variable = std::getenv("PBF_EGL_DEVICE");
    if (variable == nullptr || *variable == '\0') return {};
    wanted = variable;
    source = "PBF_EGL_DEVICE = " + wanted;
  }
  if (wanted == "hardware") return {Kind::hardware, 0, source};
  if (wanted == "software") return {Kind::software, 0, source};
  if (wanted == "surfaceless") return {Kind::surfaceless, 0, source};
  const bool cuda = wanted.starts_with("cuda:");
  if (const auto number = natural_number(cuda ? wanted.substr(5) : wanted)) {
    return {cuda ? Kind::cuda : Kind::index, *number, source};
  }
  throw InvalidParameter(source +
                         ": must be the index of an EGL device, \"hardware\", \"software\", "
                         "\"cuda:\" and CUDA's number, or \"surfaceless\"; `pbfluids doctor` lists "
                         "the devices that there are");
}

std::vector<EglDevice> ranked(std::vector<EglDevice> devices, const DeviceWish& wish) {
  std::erase_if(devices, [&](const EglDevice& device) { return !allows(wish, device); });
  std::stable_sort(devices.begin(), devices.end(), [](const EglDevice& a, const EglDevice& b) {
    const auto rank = [](const EglDevice& d) {
      return std::tuple(d.software, d.cuda.value_or(std::numeric_limits<int>::max()));
    };
    return rank(a) < rank(b);
  });
  return devices;
}

std::vector<EglDevice> egl_devices(std::vector<std::string>& notes) {
  load_egl_functions();
  if (eglQueryDevicesEXT == nullptr || eglQueryDeviceStringEXT == nullptr) {
    notes.emplace_back("EGL devices: this EGL cannot list them (no EGL_EXT_device_enumeration)");
    return {};
  }
  // All of them: Mesa leaves the software device out if asked for fewer than there are.
  EGLint count = 0;
  if (eglQueryDevicesEXT(0, nullptr, &count) == 0 || count < 1) {
    notes.push_back("EGL devices: none found (" + egl_error_text() + ")");
    return {};
  }
  std::vector<EGLDevice> handles(static_cast<std::size_t>(count));
  eglQueryDevicesEXT(count, handles.data(), &count);
  std::vector<EglDevice> devices;
  for (int k = 0; k < count; ++k) devices.push_back(described(handles[k], k));
  return devices;
}

}  // namespace pbf
