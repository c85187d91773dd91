#include "pbf/fluid/sweeps.hpp"

namespace pbf {

#define PBF_SWEEPS(Kernel, name)                     \
  PBF_TABLE_BY_ISA(Sweeps<Kernel<Real>>, name, name) \
  const Sweeps<Kernel<Real>>& sweeps(const Kernel<Real>&, Isa isa) { return name(isa); }
PBF_SWEEPS(Poly6Spiky, poly6_spiky_sweeps)
PBF_SWEEPS(CubicSpline, cubic_spline_sweeps)
PBF_SWEEPS(Wendland, wendland_sweeps)

}  // namespace pbf
