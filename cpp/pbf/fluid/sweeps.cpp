#include "pbf/fluid/sweeps.hpp"

namespace pbf {

#define PBF_DECLARE(isa)                                  \
  namespace isa {                                         \
  const Sweeps<Poly6Spiky<Real>>& poly6_spiky_sweeps();   \
  const Sweeps<CubicSpline<Real>>& cubic_spline_sweeps(); \
  }
PBF_FOR_EACH_ISA(PBF_DECLARE)
#undef PBF_DECLARE

const Sweeps<Poly6Spiky<Real>>& sweeps(const Poly6Spiky<Real>& kernel, Isa isa) {
  switch (isa) {
#define PBF_CASE(isa) \
  case Isa::isa:      \
    return isa::poly6_spiky_sweeps();
    PBF_FOR_EACH_ISA(PBF_CASE)
#undef PBF_CASE
  }
  return sweeps(kernel, usable_isas().front());
}

const Sweeps<CubicSpline<Real>>& sweeps(const CubicSpline<Real>& kernel, Isa isa) {
  switch (isa) {
#define PBF_CASE(isa) \
  case Isa::isa:      \
    return isa::cubic_spline_sweeps();
    PBF_FOR_EACH_ISA(PBF_CASE)
#undef PBF_CASE
  }
  return sweeps(kernel, usable_isas().front());
}

}  // namespace pbf
