#include "pbf/core/isa.hpp"
#include "pbf/core/threads.hpp"
#include "pbf/core/types.hpp"

#include <pybind11/stl.h>

#include "common.hpp"
#include <map>
#include <string>

namespace pbf {
namespace {

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
      {"instruction_set", isa_name(chosen_isa())},
      {"eigen", std::to_string(EIGEN_WORLD_VERSION) + "." + std::to_string(EIGEN_MAJOR_VERSION) +
                    "." + std::to_string(EIGEN_MINOR_VERSION)},
  };
}

}  // namespace

void register_build(py::module_& m) {
  m.def("build_info", &build_info, "Compiler, instruction set and libraries of this build.");
  m.def(
      "instruction_sets",
      [] {
        std::vector<std::string> names;
        for (const Isa isa : usable_isas()) names.emplace_back(isa_name(isa));
        return names;
      },
      "Instruction sets that the solver is compiled for and this processor has, plainest first.");
  m.def("usable_threads", &usable_threads, "requested"_a,
        "Threads used for a request, 0 being all.");
}

}  // namespace pbf
