#pragma once

#include "pbf/core/types.hpp"
#include "pbf/kernels/kernel.hpp"
#include "pbf/neighbors/neighbor_list.hpp"

namespace pbf {

/// A cloud of particles on which fields are differentiated: sorted and searched once, used for many
/// fields; always in space, even if the particles lie in a plane. The formulas are in
/// field_operators.hpp; arrays go in and come out in the order of the positions.
class ParticleFields {
 public:
  struct Options {
    KernelChoice kernel = KernelChoice::poly6_spiky;
    Real volume = 0;         ///< V [m³]; 0: that of the rest lattice of spacing h/2
    bool corrected = false;  ///< multiply gradients with the inverse of V Σ (x_j − x_i) ⊗ ∇W: exact
                             ///< for linear fields
    int num_threads = 0;
  };
  /// Throws InvalidParameter if h is not from 1e-6 to 1e6, the volume negative or a position not
  /// finite or beyond what CellGrid reaches.
  ParticleFields(const PointsView& positions, Real h, const Options& options);

  [[nodiscard]] Scalars relative_density() const;  ///< V Σ_j W_ij, j includes i     [–]
  [[nodiscard]] Points gradient(const ScalarsView& values) const;  ///< [A/m]
  [[nodiscard]] Eigen::Matrix<Real, 9, Eigen::Dynamic> jacobian(
      const PointsView& values) const;                               ///< row-major 3×3 [a/m]
  [[nodiscard]] Scalars divergence(const PointsView& values) const;  ///< [a/m]
  [[nodiscard]] Points curl(const PointsView& values) const;         ///< [a/m]
  [[nodiscard]] Scalars laplacian(const ScalarsView& values) const;  ///< [A/m²]; not corrected
  [[nodiscard]] Index size() const { return x_.cols(); }

 private:
  template <class F>
  void at_each(F&& f) const;

  Options options_;
  Real h_;
  CellGrid grid_;
  Points x_;  // in cell order
  NeighborList near_;
};

}  // namespace pbf
