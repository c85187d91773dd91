#pragma once

#include "pbf/kernels/kernel.hpp"

namespace pbf {

/// What makes a block sampled on the cubic lattice of spacing d, in a plane the square one, rest at
/// C = 0, for any kernel and any h/d.
struct Calibration {
  double volume = 0;  ///< V = 1 / Σ_lattice W, the particle's share of space    [m³, m² in a plane]
  double ideal_denominator =
      0;  ///< D_ideal = Σ_k ‖∇_k C‖² on the lattice, scale of all multipliers [1/m²]
};

/// Sums over the lattice points within h of one of them. Throws InvalidParameter unless 0 < spacing
/// < h.
Calibration calibrate(KernelChoice choice, int dimensions, double spacing, double h);

/// Of the matrix that takes multipliers to the change of C they make, each row divided by its
/// diagonal: on the lattice it is a convolution, whose eigenvalues are
///   |Σ_r V ∇W(r) sin(k·r)|² / D_ideal
/// over the wave vectors k. Simultaneous steps longer than 2 over the largest make errors grow.
/// 0 < spacing < h.
double largest_eigenvalue(KernelChoice choice, int dimensions, double spacing, double h);

}  // namespace pbf
