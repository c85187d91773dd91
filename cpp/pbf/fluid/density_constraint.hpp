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
/// ε = relaxation · D_ideal.
/// Departure from the paper: V takes the place of m/ρ0, and ε is scaled with the lattice
/// (docs/notation.md).
///
/// Everything here gathers: particle i reads its neighbors and writes its own slot.

/// C_i + 1 = ρ_i/ρ0 for each particle.
void relative_densities(const Neighborhood& near,
                        const Discretization& disc,
                        const PointsView& x_star,
                        int threads,
                        Scalars& relative_density);

/// λ_i for each particle, and C_i + 1 on the way.
void solve_multipliers(const Neighborhood& near,
                       const Discretization& disc,
                       const SolverParams& solver,
                       const PointsView& x_star,
                       Scalars& relative_density,
                       Scalars& lambda);

/// Δp_i for each particle.
void compute_corrections(const Neighborhood& near,
                         const Discretization& disc,
                         const SolverParams& solver,
                         const PointsView& x_star,
                         const ScalarsView& lambda,
                         Points& dp);

/// x* ← project(x* + Δp), and the displacement u = x* − x with it: collision detection and response
/// have the last word in every iteration.
void apply_corrections(const Discretization& disc,
                       const PointsView& x,
                       const PointsView& dp,
                       int threads,
                       Points& x_star,
                       Points& u);

}  // namespace pbf
