#include "pbf/fluid/sweeps.hpp"

namespace pbf {

#define PBF_DECLARE(isa)                                  \
  namespace isa {                                         \
  const Sweeps<Poly6Spiky<Real>>& poly6_spiky_sweeps();   \
  const Sweeps<CubicSpline<Real>>& cubic_spline_sweeps(); \
  }
PBF_FOR_EACH_ISA(PBF_DECLARE)
#undef PBF_DECLARE

const Sweeps<Poly6Spiky<Real>>& sweeps(const Poly6Spiky<Real>&, Isa isa) {
  using FindTable = const Sweeps<Poly6Spiky<Real>>& (*)();
#define PBF_TABLE(isa) isa::poly6_spiky_sweeps,
  static constexpr FindTable tables[] = {PBF_FOR_EACH_ISA(PBF_TABLE)};
#undef PBF_TABLE
  return tables[static_cast<std::size_t>(isa)]();
}

const Sweeps<CubicSpline<Real>>& sweeps(const CubicSpline<Real>&, Isa isa) {
  using FindTable = const Sweeps<CubicSpline<Real>>& (*)();
#define PBF_TABLE(isa) isa::cubic_spline_sweeps,
  static constexpr FindTable tables[] = {PBF_FOR_EACH_ISA(PBF_TABLE)};
#undef PBF_TABLE
  return tables[static_cast<std::size_t>(isa)]();
}

}  // namespace pbf
