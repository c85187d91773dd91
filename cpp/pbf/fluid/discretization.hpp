#pragma once

#include "pbf/boundary/boundary_list.hpp"
#include "pbf/boundary/ghosts.hpp"
#include "pbf/core/types.hpp"
#include "pbf/fluid/params.hpp"
#include "pbf/kernels/calibration.hpp"
#include "pbf/neighbors/neighbor_list.hpp"

namespace pbf {

/// A fluid's parameters with what follows from them once: calibration and walls.
struct Discretization {
  FluidParams fluid;
  std::optional<Box> domain;
  Real h;                  ///< support radius                                       [m]
  Real V;                  ///< particle volume on the rest lattice       [m³, in 2-D m²]
  Real ideal_denominator;  ///< D_ideal: Σ_k ‖∇_k C‖² on the rest lattice            [1/m²]
  Real largest_eigenvalue;  ///< of the iteration's matrix on the rest lattice        [–]
  std::optional<WallLattice> walls;
  /// Where particle centers may be: the domain less half a spacing from every wall, the radius of a
  /// particle; infinite along axes without walls. The solver's wall pressure is half of what a
  /// mirrored neighbor would give (λ_k is not there to add), so left to itself the first layer
  /// would settle a quarter of a spacing closer to the wall than on the rest lattice, and the fluid
  /// would lose that volume.
  std::optional<Box> centers;

  /// Throws InvalidParameter if the parameters break a rule, or the domain is thinner than a
  /// particle or than two support radii along a periodic axis.
  explicit Discretization(const FluidParams& params, const std::optional<Box>& box = {});

  /// Whether there is a wall along any axis.
  [[nodiscard]] bool has_walls() const {
    return centers &&
           (centers->lower.array().isFinite() || centers->upper.array().isFinite()).any();
  }
  /// Whether a particle may be at x. In 2-D the plane may lie anywhere along z.
  [[nodiscard]] bool contains(const Vec3& x) const {
    return !domain || domain->open_along({false, false, fluid.dimensions == 2}).contains(x);
  }
};

/// Who is near whom, in sorted order: found once per step at the predicted positions.
struct Neighborhood {
  Ghosts ghosts;
  NeighborList fluid;
  BoundaryList boundary;

  /// Finds the grid's order of x, behind which the ghosts are put.
  void sort(Records& x, const Discretization& disc, int threads, CellGrid& grid);
  /// @param grid  of the sort
  /// @param x     the particles in its order; the ghosts are put behind them
  void build(const CellGrid& grid, const Discretization& disc, int threads, Records& x);
};

}  // namespace pbf
