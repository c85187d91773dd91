// Compiled once per instruction set (cpp/CMakeLists.txt).
#include "pbf/fluid/coarse_lanes.hpp"
#include "pbf/fluid/density_constraint_lanes.hpp"
#include "pbf/fluid/vorticity_lanes.hpp"
#include "pbf/fluid/xsph_lanes.hpp"

namespace pbf::PBF_ISA_NAMESPACE {
namespace {

template <class Kernel>
constexpr Sweeps<Kernel> kSweeps{multipliers<Kernel>, pressures<Kernel>,      corrections<Kernel>,
                                 virials<Kernel>,     coarse_motions<Kernel>, densities<Kernel>,
                                 xsph<Kernel>,        vorticity<Kernel>,      confinement<Kernel>};

}  // namespace

const Sweeps<Poly6Spiky<Real>>& poly6_spiky_sweeps() { return kSweeps<Poly6Spiky<Real>>; }
const Sweeps<CubicSpline<Real>>& cubic_spline_sweeps() { return kSweeps<CubicSpline<Real>>; }
const Sweeps<Wendland<Real>>& wendland_sweeps() { return kSweeps<Wendland<Real>>; }

}  // namespace pbf::PBF_ISA_NAMESPACE
