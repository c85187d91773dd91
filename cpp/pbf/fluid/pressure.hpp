#pragma once

#include "pbf/fluid/coarse_level.hpp"

#include <vector>

namespace pbf {

/// The multipliers of a whole time step as pressures: what the iterations add up to is kept, so
/// that it can be bounded, softened, predicted from the last step and sped up. With the symbols of
/// fluid/density_constraint.hpp and Λ_i the sum of particle i's multipliers over a step,
///   p̂_i = −ρ0 Λ_i / Δt²                                                             [Pa]
/// x* stands at the guess y, not at Λ; each iteration finds at x*
///   r_i  = C_i + α̃ y_i ,  α̃ = compliance/Δt²                XPBD [MMC16]            [–]
///   D_i  = Σ_k ‖∇_k C_i‖² + ε + α̃                                                   [1/m²]
///   Λ_i' = min(y_i − ω r_i/D_i, −floor/D_i)                                         [m²]
///   y_i' = Λ_i' + β (Λ_i' − Λ_i) ,  δ_i = y_i' − y_i        Nesterov [Nes83]        [m²]
/// and moves x* by the corrections of the multipliers δ. The bound is constraint_floor's, on the
/// sum: a fluid pushes and does not pull (floor 0), yet a push may be taken back in a later
/// iteration, which a floor on every single iteration forbids. ω is one over
/// largest_eigenvalue(), the step that no error of the rest lattice overshoots. β grows
/// as momentum does in Nesterov's method, and starts again where the last way led uphill [OC15].
/// Corrections are the antisymmetric ones of every iteration, so the fluid's momentum is kept for
/// any δ.
///
/// A step starts from Λ = s Λ_last (Δt/Δt_last)², a push along gradients of where the fluid was
/// about to go. Where that is far, they do not hold, and what one step throws the next throws
/// back: s is warm_start, or less, so that no Λ is larger than half a squared spacing.

/// What the particles' r and ways tell about an iteration.
struct PressureErrors {
  double sum = 0;     ///< Σ max(r, 0)
  double max = 0;     ///< largest r
  double uphill = 0;  ///< Σ D (y − Λ') (Λ' − Λ): > 0 where momentum leads away
  PressureErrors& operator+=(const PressureErrors& other);
};

/// The pressure that the forces of a step amount to. On the way from p̂ to forces, sums over a few
/// neighbors stand for integrals: on arrangements as they are in a fluid they come to 0.93 … 0.97
/// of them, beside a wall, whose particles have no multiplier, to less, and p̂ grows until its
/// forces hold the fluid all the same. What the fluid feels is the momentum that goes from particle
/// to particle, a third of the trace of the mean virial [IK50]: of every pair's force one half is
/// i's.
///   p_i = V/(2n) Σ_k (p̂_i + p̂_k) (x_i − x_k)·(−∇W_ik)                               [Pa]
/// n dimensions, k over neighbors and boundary particles. For the latter, which have no multiplier,
/// p̂_i/3 stands: with 0, what collision response holds in their stead would be left out, with p̂_i
/// it would count at side walls as well, which hold no weight. In a tank at rest the layers at
/// floor and walls then err by the same to either side.
/// @param x_p  (x, p̂)
/// @param p    (·, p)
void virial_pressures(const Neighborhood& near,
                      const Discretization& disc,
                      const Records& x_p,
                      int threads,
                      Records& p);

class PressureSolve {
 public:
  /// Begins a step: the first corrections are those of a share of the last step's multipliers, for
  /// this step's length. Particles that had come free start from nothing.
  /// @param v_density  (·, ρ/ρ0) at the end of the last step
  /// @param totals     Λ of the last step, last_dt long; 0: there was none
  void begin(const Neighborhood& near,
             const Discretization& disc,
             const SolverParams& solver,
             const Records& x_star,
             const Records& v_density,
             const std::vector<Real>& totals,
             Real dt,
             Real last_dt,
             Records& x_delta);

  /// One iteration: (x*, δ).
  PressureErrors iterate(const Neighborhood& near,
                         const Discretization& disc,
                         const SolverParams& solver,
                         Real dt,
                         const Records& x_star,
                         Records& x_delta);

  /// Adds the coarse level's corrections to those of the first iteration.
  void correct_coarse(const Neighborhood& near,
                      const Discretization& disc,
                      const SolverParams& solver,
                      Real dt,
                      const Records& x_star,
                      Records& x_delta);

  [[nodiscard]] std::size_t bytes() const {
    return static_cast<std::size_t>(states_.size()) * sizeof(Record) + coarse_.bytes();
  }

 private:
  Records states_;  // (Λ, y, r, what it adds to uphill)
  double t_ = 1;    // of Nesterov's sequence
  CoarseLevel coarse_;
};

}  // namespace pbf
