#pragma once

#include <cstddef>
#include <vector>

/// The instruction sets that hot loops are compiled for: one source, a library per level
/// (cpp/CMakeLists.txt), the level chosen at run time. The names are those of the x86-64 psABI's
/// microarchitecture levels; elsewhere there is only what the compiler takes by itself.
#if defined(__x86_64__)
#define PBF_FOR_EACH_ISA(f, ...)                                               \
  f(x86_64 __VA_OPT__(, ) __VA_ARGS__) f(x86_64_v2 __VA_OPT__(, ) __VA_ARGS__) \
      f(x86_64_v3 __VA_OPT__(, ) __VA_ARGS__) f(x86_64_v4 __VA_OPT__(, ) __VA_ARGS__)
#else
#define PBF_FOR_EACH_ISA(f, ...) f(baseline __VA_OPT__(, ) __VA_ARGS__)
#endif

/// Inside namespace pbf: defines `const Table& pick(Isa)`, which gives the table of loops that a
/// file compiled for each instruction set offers there as `const Table& find()`.
#define PBF_TABLE_BY_ISA(Table, find, pick)                                    \
  PBF_FOR_EACH_ISA(PBF_DECLARE_TABLE, Table, find)                             \
  const Table& pick(Isa isa) {                                                 \
    using Find = const Table& (*)();                                           \
    static constexpr Find tables[] = {PBF_FOR_EACH_ISA(PBF_NAME_TABLE, find)}; \
    return tables[static_cast<std::size_t>(isa)]();                            \
  }
#define PBF_DECLARE_TABLE(isa, Table, find) \
  namespace isa {                           \
  const Table& find();                      \
  }
#define PBF_NAME_TABLE(isa, find) isa::find,

namespace pbf {

#define PBF_ENUMERATOR(isa) isa,
enum class Isa { PBF_FOR_EACH_ISA(PBF_ENUMERATOR) };
#undef PBF_ENUMERATOR

/// "x86-64-v3": as compilers and the environment variable PBF_ISA spell it.
const char* isa_name(Isa isa);

/// What this processor can run, the plainest first.
std::vector<Isa> usable_isas();

/// The last of usable_isas(), or what the environment variable PBF_ISA asks for. Throws
/// InvalidParameter if that is not one of them. Results have the same bits with each.
Isa chosen_isa();

}  // namespace pbf
