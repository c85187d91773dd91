#pragma once

#include "pbf/fluid/coarse_system.hpp"

namespace pbf {

/// A second level for the pressures of fluid/pressure.hpp. An iteration over particles carries a
/// correction two support radii far, so what is wrong over the height of a tank takes many. Here it
/// is solved for at once, on a grid of cells some spacings wide, with multipliers μ_c at their
/// corners and the trilinear functions w_c between them: the coarse grid correction of multigrid,
/// its matrix that of Galerkin [BHM00].
///   δ_i   = a_i Σ_c w_c(x_i) μ_c ,  a_i = 1 where Λ_i < 0, else 0                    [m²]
///   Δp_i  = V Σ_j (δ_i + δ_j) ∇W_ij + V Σ_k δ_i ∇W_ik ≈ Σ_c G_ic μ_c                [m]
///   G_ic  = w_c(x_i) g_i + B_i ∇w_c(x_i)                                            [1/m]
///   g_i   = V Σ_j (a_i + a_j) ∇W_ij + V Σ_k a_i ∇W_ik                               [1/m]
///   B_i   = V Σ_j a_j ∇W_ij (x_j − x_i)ᵀ , for w_c is nearly linear within h of i   [–]
///   Σ_c' Σ_i (G_ic·G_ic' + α̃ a_i w_c w_c') μ_c' = −Σ_i a_i w_c(x_i) r_i
/// The particles tell where the fluid ends: behind a free surface there are none under pressure.
/// Where i touches a wall, its Δp across that wall is taken to be 0, since collision response takes
/// it back; without this the coarse level would know of no floor. The fluid feels nothing of what
/// is approximate here: its corrections are the antisymmetric ones of every iteration.
///
/// Only for fluid that has walls to stand on. Elsewhere nothing is deep, a grid that stands still
/// would make drops depend on where they are, and fluid that fills a periodic box can be under any
/// constant pressure.
///
/// All this counts on gradients that stay as they are. Deep water in long steps is pushed farther
/// than they hold, and would explode: all δ are scaled down until the largest of them and the
/// largest |Λ| before come to no more than a squared spacing.
class CoarseLevel {
 public:
  /// Adds δ to the multipliers of the states (Λ, y, r, ·), y = Λ, and to those of (x*, δ).
  void correct(const Neighborhood& near,
               const Discretization& disc,
               Real compliance,
               int threads,
               const Records& x_star,
               Records& states,
               Records& x_delta);

  [[nodiscard]] std::size_t bytes() const;

 private:
  /// The cells that a chunk of particles is in.
  struct Chunk {
    std::vector<CellKey> keys;
    std::vector<CoarseCell> cells;
    std::vector<std::uint32_t> places;  // in the system
    std::size_t find(CellKey key, std::size_t guess) const;
  };
  void gather(const Neighborhood& near,
              const Discretization& disc,
              const CoarseGrid& grid,
              Real compliance,
              int threads,
              const Records& states);

  Records x_pressed_;  // (x*, a)
  std::vector<Chunk> chunks_;
  CoarseSystem system_;
};

}  // namespace pbf
