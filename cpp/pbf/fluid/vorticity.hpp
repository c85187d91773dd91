#pragma once

#include "pbf/fluid/discretization.hpp"

namespace pbf {

/// Vorticity confinement, Eqs. 15–16 [MM13], with volumes:
///   ω_i = V Σ_j (v_j − v_i) × ∇_j W(x_i − x_j)       the curl of field_operators.hpp   [1/s]
///   η_i = V Σ_j ‖ω_j‖ ∇W_ij ,   N = η/‖η‖            points where ‖ω‖ grows            [1/(m s)]
///   v_i ← v_i + dt · strength · (N × ω_i)            strength in m/s                   [m/s]
/// N = 0 where ‖η‖ h ≤ 1e-4 ‖ω_i‖: a direction out of rounding errors would push at random.

/// ω, and (x, ‖ω‖) for confine_vorticity to gather.
void compute_vorticity(const Neighborhood& near,
                       const Discretization& disc,
                       const Records& x,
                       const Records& v,
                       int threads,
                       Records& omega,
                       Records& x_strength);

void confine_vorticity(const Neighborhood& near,
                       const Discretization& disc,
                       const Records& x_strength,
                       const Records& omega,
                       Real strength,
                       Real dt,
                       int threads,
                       Records& v);

}  // namespace pbf
