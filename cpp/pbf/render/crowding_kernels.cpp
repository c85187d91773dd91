#include "pbf/render/crowding_kernels.hpp"

namespace pbf {

#define PBF_DECLARE(isa)                     \
  namespace isa {                            \
  const CrowdingKernels& crowding_kernels(); \
  }
PBF_FOR_EACH_ISA(PBF_DECLARE)
#undef PBF_DECLARE

const CrowdingKernels& crowding_kernels(Isa isa) {
  using FindTable = const CrowdingKernels& (*)();
#define PBF_TABLE(isa) isa::crowding_kernels,
  static constexpr FindTable tables[] = {PBF_FOR_EACH_ISA(PBF_TABLE)};
#undef PBF_TABLE
  return tables[static_cast<std::size_t>(isa)]();
}

}  // namespace pbf
