#include "pbf/render/raster/smooth_kernels.hpp"

namespace pbf {

#define PBF_DECLARE(isa)                         \
  namespace isa {                                \
  const raster::SmoothKernels& smooth_kernels(); \
  }
PBF_FOR_EACH_ISA(PBF_DECLARE)
#undef PBF_DECLARE

const raster::SmoothKernels& raster::smooth_kernels(Isa isa) {
  using FindTable = const SmoothKernels& (*)();
#define PBF_TABLE(isa) isa::smooth_kernels,
  static constexpr FindTable tables[] = {PBF_FOR_EACH_ISA(PBF_TABLE)};
#undef PBF_TABLE
  return tables[static_cast<std::size_t>(isa)]();
}

}  // namespace pbf
