#include "pbf/core/threads.hpp"
#include "pbf/core/types.hpp"

#include <pybind11/stl.h>

#include "common.hpp"
#include <map>
#include <string>

namespace pbf {
namespace {

/// The instructions that this code was compiled for.
const char* instruction_set() {
#if defined(__AVX512F__)
  return "AVX-512";
#elif defined(__AVX2__)
  return "AVX2";
#elif defined(__SSE2__)
  return "SSE2";
#elif defined(__ARM_NEON)
  return "NEON";
#else
  return "scalar";
#endif
}

const char* compiler() {
#if defined(__clang__)
  return "clang " __clang_version__;
#else
  return "gcc " __VERSION__;
#endif
}

std::map<std::string, std::string> build_info() {
  return {
      {"compiler", compiler()},
      {"instruction_set", instruction_set()},
      {"eigen", std::to_string(EIGEN_WORLD_VERSION) + "." + std::to_string(EIGEN_MAJOR_VERSION) +
                    "." + std::to_string(EIGEN_MINOR_VERSION)},
  };
}

}  // namespace

void register_build(py::module_& m) {
  m.def("build_info", &build_info, "Compiler, instruction set and libraries of this build.");
  m.def("usable_threads", &usable_threads, "requested"_a,
        "Threads used for a request, 0 being all.");
}

}  // namespace pbf
