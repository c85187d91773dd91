#include "pbf/render/raster/curvature_flow_kernels.hpp"

namespace pbf {

#define PBF_DECLARE(isa)                     \
  namespace isa {                            \
  const raster::FlowKernels& flow_kernels(); \
  }
PBF_FOR_EACH_ISA(PBF_DECLARE)
#undef PBF_DECLARE

const raster::FlowKernels& raster::flow_kernels(Isa isa) {
  using FindTable = const FlowKernels& (*)();
#define PBF_TABLE(isa) isa::flow_kernels,
  static constexpr FindTable tables[] = {PBF_FOR_EACH_ISA(PBF_TABLE)};
#undef PBF_TABLE
  return tables[static_cast<std::size_t>(isa)]();
}

}  // namespace pbf
