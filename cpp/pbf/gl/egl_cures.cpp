#include "pbf/gl/egl_cures.hpp"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string_view>
#include <unistd.h>

namespace pbf {
namespace {

/// "renderD128" is the stem "renderD" and a number.
bool is_numbered(std::string_view name, std::string_view stem) {
  return name.starts_with(stem) && name.size() > stem.size() &&
         std::all_of(name.begin() + stem.size(), name.end(),
                     [](unsigned char c) { return std::isdigit(c) != 0; });
}

bool is_set(const char* variable) {
  const char* value = std::getenv(variable);
  return value != nullptr && *value != '\0';
}

/// "/dev/dri/renderD128: Permission denied" for each GPU whose file may not be opened.
std::string closed_files() {
  std::string files;
  for (const std::string& file : visible_gpus()) {
    if (access(file.c_str(), R_OK | W_OK) == 0) continue;
    files += (files.empty() ? "" : ", ") + file + ": " + std::strerror(errno);
  }
  return files;
}

}  // namespace

std::vector<std::string> visible_gpus() {
  std::vector<std::string> files;
  std::error_code none;
  for (const auto& [folder, stem] :
       {std::pair{"/dev/dri", "renderD"}, std::pair{"/dev", "nvidia"}}) {
    for (const auto& entry : std::filesystem::directory_iterator(folder, none)) {
      if (is_numbered(entry.path().filename().string(), stem)) files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<std::string> egl_cures() {
  std::vector<std::string> cures{"software rendering: apt-get install libegl1 libgl1-mesa-dri"};
  if (const std::string files = closed_files(); !files.empty()) {
    cures.push_back("may not be opened: " + files + "; usermod -aG render,video $USER");
  }
  if (std::filesystem::exists("/dev/nvidiactl") || is_set("NVIDIA_VISIBLE_DEVICES")) {
    cures.emplace_back(
        "NVIDIA in a container: docker run --gpus all -e NVIDIA_DRIVER_CAPABILITIES=all");
  }
  if (is_set("LIBGL_ALWAYS_SOFTWARE")) {
    cures.emplace_back("LIBGL_ALWAYS_SOFTWARE is set, which keeps Mesa from hardware: unset it");
  }
  if (is_set("CONDA_PREFIX")) {
    cures.emplace_back(
        "conda: its libstdc++ may be too old for the system's driver "
        "(conda install -c conda-forge libstdcxx-ng)");
  }
  return cures;
}

}  // namespace pbf
