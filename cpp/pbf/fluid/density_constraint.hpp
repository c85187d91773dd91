#pragma once

#include "pbf/fluid/discretization.hpp"

namespace pbf {

/// The density constraint of Position Based Fluids [MM13], with volumes so that every term has a
/// unit.
///   C_i     = V Σ_j W(x*_i − x*_j) + V Σ_k W(x*_i − q_k) − 1                 Eq. 1   [–]
///   ∇_i C_i = V Σ_{j≠i} ∇W_ij + V Σ_k ∇W_ik ,   ∇_j C_i = −V ∇W_ij           Eq. 8   [1/m]
///   λ_i     = −max(C_i, floor) / (Σ_k ‖∇_k C_i‖² + ε)                        Eq. 11  [m²]
///   Δp_i    = V Σ_{j≠i} (λ_i + λ_j + s_ij) ∇W_ij + V Σ_k (λ_i + s_ik) ∇W_ik  Eq. 14  [m]
/// The sum over j in C_i includes i; q_k are boundary particles, which do not move;
/// ε = relaxation · D_ideal; s is artificial repulsion against the tensile instability:
///   s(r)    = −k (W(r)/W(Δq))ⁿ ,  k = tensile_strength / D_ideal ,  Δq = tensile_distance · h
///                                                                            Eq. 13  [m²]
/// Departures from the paper: V takes the place of m/ρ0, and ε and k are measured on the rest
/// lattice, so that they mean the same at every resolution (docs/notation.md).
///
/// Everything here gathers: particle i reads its neighbors and writes its own record. The sums are
/// in density_constraint_lanes.hpp.

/// Throws InvalidParameter if s at the rest distance is more than the multiplier of C = 1: fluid at
/// rest would explode, and shorter steps would make it worse.
void require_moderate_repulsion(const Discretization& disc, const SolverParams& solver);

/// (·, C_i + 1 = ρ_i/ρ0) for each particle; what stood in x, y, z stays.
void relative_densities(const Neighborhood& near,
                        const Discretization& disc,
                        const Records& x,
                        int threads,
                        Records& density);

/// (x*_i, λ_i) for each particle.
void solve_multipliers(const Neighborhood& near,
                       const Discretization& disc,
                       const SolverParams& solver,
                       const Records& x_star,
                       Records& x_lambda);

/// x* ← project(x* + Δp), and the displacement u = x* − x with it: collision detection and response
/// have the last word in every iteration. u grows by Δp, or by what a wall leaves of it.
void apply_corrections(const Neighborhood& near,
                       const Discretization& disc,
                       const SolverParams& solver,
                       const Records& x_lambda,
                       const Records& x,
                       Records& x_star,
                       Records& u);

}  // namespace pbf
