#pragma once

#include <optional>
#include <string>
#include <vector>

namespace pbf {

/// A device in EGL's list.
struct EglDevice {
  void* handle = nullptr;
  int index = 0;  ///< place in the list
  bool software = false;
  std::optional<int> cuda{};  ///< CUDA's number for it, which CUDA_VISIBLE_DEVICES counts
  std::string file{};         ///< "/dev/dri/renderD128"; empty if the driver does not say
  std::string name{};         ///< "EGL device 0 (/dev/dri/renderD128, CUDA 1)"
};

/// Which device is wanted, and who says so.
struct DeviceWish {
  enum class Kind { any, hardware, software, surfaceless, index, cuda };
  Kind kind = Kind::any;
  int number = 0;        ///< of index and cuda
  std::string source{};  ///< "PBF_EGL_DEVICE = 1"; empty for any
};

/// Reads "hardware", "software", "surfaceless", an index, or "cuda:N". An empty text leaves the
/// choice to the environment variable PBF_EGL_DEVICE, and if that is empty too, open. Throws
/// InvalidParameter for any other text.
DeviceWish device_wish(const std::string& text);

/// Those that the wish allows, in the order in which to try them: the GPU that CUDA calls 0, so
/// that drawing happens where this process computes, other GPUs of CUDA, other hardware, software.
std::vector<EglDevice> ranked(std::vector<EglDevice> devices, const DeviceWish& wish);

/// All devices. The first call opens libEGL; needs an EglTurn. A reason why there are none goes to
/// `notes`.
std::vector<EglDevice> egl_devices(std::vector<std::string>& notes);

}  // namespace pbf
