#include "pbf/fluid/sweeps.hpp"

namespace pbf {

#define PBF_DECLARE(isa)                                  \
  namespace isa {                                         \
  const Sweeps<Poly6Spiky<Real>>& poly6_spiky_sweeps();   \
  const Sweeps<CubicSpline<Real>>& cubic_spline_sweeps(); \
  const Sweeps<Wendland<Real>>& wendland_sweeps();        \
  }
PBF_FOR_EACH_ISA(PBF_DECLARE)
#undef PBF_DECLARE

/// The table of an instruction set; `find` are the functions that give it, in order of Isa.
#define PBF_SWEEPS_OF(Kernel, name)                                          \
  const Sweeps<Kernel<Real>>& sweeps(const Kernel<Real>&, Isa isa) {         \
    using FindTable = const Sweeps<Kernel<Real>>& (*)();                     \
    static constexpr FindTable find[] = {PBF_FOR_EACH_ISA(PBF_##name##_OF)}; \
    return find[static_cast<std::size_t>(isa)]();                            \
  }
#define PBF_poly6_spiky_OF(isa) isa::poly6_spiky_sweeps,
#define PBF_cubic_spline_OF(isa) isa::cubic_spline_sweeps,
#define PBF_wendland_OF(isa) isa::wendland_sweeps,
PBF_SWEEPS_OF(Poly6Spiky, poly6_spiky)
PBF_SWEEPS_OF(CubicSpline, cubic_spline)
PBF_SWEEPS_OF(Wendland, wendland)

}  // namespace pbf
