#include "pbf/core/isa.hpp"

#include "pbf/core/error.hpp"

#include <cstdlib>
#include <string>

namespace pbf {
namespace {

bool runs_here([[maybe_unused]] Isa isa) {
#if defined(__x86_64__)
  switch (isa) {
    case Isa::x86_64:
      return true;
    case Isa::x86_64_v2:
      return __builtin_cpu_supports("sse4.2") != 0 && __builtin_cpu_supports("popcnt") != 0;
    case Isa::x86_64_v3:
      return __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0 &&
             __builtin_cpu_supports("bmi") != 0 && __builtin_cpu_supports("bmi2") != 0;
    case Isa::x86_64_v4:
      return runs_here(Isa::x86_64_v3) && __builtin_cpu_supports("avx512f") != 0 &&
             __builtin_cpu_supports("avx512bw") != 0 && __builtin_cpu_supports("avx512cd") != 0 &&
             __builtin_cpu_supports("avx512dq") != 0 && __builtin_cpu_supports("avx512vl") != 0;
  }
#endif
  return true;
}

}  // namespace

const char* isa_name(Isa isa) {
  switch (isa) {
#if defined(__x86_64__)
    case Isa::x86_64:
      return "x86-64";
    case Isa::x86_64_v2:
      return "x86-64-v2";
    case Isa::x86_64_v3:
      return "x86-64-v3";
    case Isa::x86_64_v4:
      return "x86-64-v4";
#else
    case Isa::baseline:
      return "baseline";
#endif
  }
  return "";
}

std::vector<Isa> usable_isas() {
  std::vector<Isa> usable;
#define PBF_PUSH(name) \
  if (runs_here(Isa::name)) usable.push_back(Isa::name);
  PBF_FOR_EACH_ISA(PBF_PUSH)
#undef PBF_PUSH
  return usable;
}

Isa chosen_isa() {
  static const std::vector<Isa> usable = usable_isas();
  const char* wanted = std::getenv("PBF_ISA");
  if (wanted == nullptr || *wanted == '\0') return usable.back();
  std::string names;
  for (const Isa isa : usable) {
    if (wanted == std::string(isa_name(isa))) return isa;
    names += (names.empty() ? "" : ", ") + std::string(isa_name(isa));
  }
  throw InvalidParameter("PBF_ISA = \"" + std::string(wanted) + "\": must be one of " + names +
                         " on this processor, or not set");
}

}  // namespace pbf
