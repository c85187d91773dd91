#pragma once

#include "pbf/core/isa.hpp"
#include "pbf/core/records.hpp"
#include "pbf/kernels/cubic_spline.hpp"
#include "pbf/kernels/poly6_spiky.hpp"
#include "pbf/kernels/wendland.hpp"
#include "pbf/neighbors/sliced_rows.hpp"

#include <array>

namespace pbf {

/// A stretch of particles and what is near them: what a sweep works through.
struct Stretch {
  Index first, last;  ///< first is a multiple of kChunk, last at most one chunk farther
  SliceView<std::uint32_t> neighbors;
  SliceView<Real> walls;
};

/// Artificial repulsion, Eq. 13 [MM13]: s = −k (W/W(Δq))ⁿ [m²]. The factors stand inside the
/// power, where they cost nothing.
template <class Kernel>
struct TensileTerms {
  Kernel root;   ///< k^(1/n) W/W(Δq)
  int exponent;  ///< n; 0: none
};

/// How a multiplier moves towards what its constraint asks for (fluid/pressure.hpp), as numbers.
struct PressureTerms {
  Real epsilon;     ///< [1/m²]
  Real floor;       ///< [–]
  Real compliance;  ///< α̃ = α/Δt² [1/m²]
  Real step;        ///< ω [–]
  Real momentum;    ///< β [–]
};

/// How the particles of a stretch move with the coarse level's multipliers
/// (fluid/coarse_level.hpp): (B_i, g_i), row by row, and room for whole vectors.
struct CoarseMotions {
  static constexpr std::size_t kRows = static_cast<std::size_t>(kChunk + kMostLanes);
  std::array<Record, kRows> x, y, z;
};

/// Where particle centers may be.
struct Bounds3 {
  Real lower[3], upper[3];
};

/// The loops over pairs of particles, for one kernel and one instruction set. The formulas are in
/// the headers of the stages; a kernel comes with the particle volume V as its factor. Every sweep
/// reads what is near its particles and writes their own records only, other records than it reads.
template <class Kernel>
struct Sweeps {
  /// (x*, λ) from x*
  void (*multipliers)(const Kernel& VW,
                      const Stretch& at,
                      Real epsilon,
                      Real floor,
                      const Record* x_star,
                      Record* x_lambda);
  /// (x*, δ) and the states (Λ, y, r, m) from x* and those states
  void (*pressures)(const Kernel& VW,
                    const Stretch& at,
                    const PressureTerms& terms,
                    const Record* x_star,
                    Record* states,
                    Record* x_delta);
  /// x* and u = x* − x from (x*, λ); λ adds up in u's fourth number
  void (*corrections)(const Kernel& VW,
                      const Stretch& at,
                      const TensileTerms<Kernel>& tensile,
                      const Bounds3& centers,
                      const Record* x_lambda,
                      const Record* x,
                      Record* x_star,
                      Record* u);
  /// (·, sum of the virial) from (x, p̂)
  void (*virials)(const Kernel& VW, const Stretch& at, const Record* x_p, Record* virial);
  /// (B, g) from (x*, a)
  void (*coarse_motions)(const Kernel& VW,
                         const Stretch& at,
                         const Record* x_pressed,
                         CoarseMotions& motions);
  /// (·, ρ/ρ0) from x
  void (*densities)(const Kernel& VW, const Stretch& at, const Record* x, Record* density);
  /// (v, ρ/ρ0) from x and v
  void (*xsph)(const Kernel& VW,
               const Stretch& at,
               Real strength,
               const Record* x,
               const Record* v,
               Record* v_new);
  /// ω, and (x, ‖ω‖), from x and v
  void (*vorticity)(const Kernel& VW,
                    const Stretch& at,
                    const Record* x,
                    const Record* v,
                    Record* omega,
                    Record* x_strength);
  /// v from (x, ‖ω‖) and ω
  void (*confinement)(const Kernel& VW,
                      const Stretch& at,
                      Real impulse,
                      const Record* x_strength,
                      const Record* omega,
                      Record* v);
};

const Sweeps<Poly6Spiky<Real>>& sweeps(const Poly6Spiky<Real>& kernel, Isa isa);
const Sweeps<CubicSpline<Real>>& sweeps(const CubicSpline<Real>& kernel, Isa isa);
const Sweeps<Wendland<Real>>& sweeps(const Wendland<Real>& kernel, Isa isa);

}  // namespace pbf
