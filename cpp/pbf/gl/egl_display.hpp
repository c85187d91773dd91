#pragma once

#include "pbf/gl/egl_device.hpp"
#include "pbf/gl/functions.hpp"

#include <string>
#include <vector>

namespace pbf {

/// Something a context might be made on.
struct EglPlatform {
  std::string name;  ///< "EGL device 0 (software)", "surfaceless"
  EGLenum platform;
  EglDevice device;  ///< its handle is null for the surfaceless platform
};

/// Platforms in the order in which to try them: devices, then the surfaceless platform. Notes for
/// the error message, such as "no EGL device was found", go to `notes`. Throws RendererUnavailable,
/// with the devices that there are, if the wish names one that is not there.
std::vector<EglPlatform> egl_platforms(const DeviceWish& wish, std::vector<std::string>& notes);

/// The initialized display of a platform, the same one each time. It is never terminated: that
/// would take it from every other context of the process too. Null if it cannot be had: eglGetError
/// knows why.
EGLDisplay open_display(const EglPlatform& platform);

/// The last EGL error in words and what it usually means here.
std::string egl_error_text();

/// Whether a space-separated list of extensions, which may be null, holds a name.
bool has_extension(const char* list, const char* name);

}  // namespace pbf
