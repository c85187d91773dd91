#include "pbf/render/raster/splat_kernels.hpp"

namespace pbf {

#define PBF_DECLARE(isa)                       \
  namespace isa {                              \
  const raster::SplatKernels& splat_kernels(); \
  }
PBF_FOR_EACH_ISA(PBF_DECLARE)
#undef PBF_DECLARE

const raster::SplatKernels& raster::splat_kernels(Isa isa) {
  using FindTable = const SplatKernels& (*)();
#define PBF_TABLE(isa) isa::splat_kernels,
  static constexpr FindTable tables[] = {PBF_FOR_EACH_ISA(PBF_TABLE)};
#undef PBF_TABLE
  return tables[static_cast<std::size_t>(isa)]();
}

}  // namespace pbf
