#pragma once

#include <string>
#include <vector>

namespace pbf {

/// Device files of GPUs: what a container or a machine shows of them, usable or not.
std::vector<std::string> visible_gpus();

/// What to do where no context can be made, or none on a GPU: lines for whoever reads the error,
/// picked by what this machine shows.
std::vector<std::string> egl_cures();

}  // namespace pbf
