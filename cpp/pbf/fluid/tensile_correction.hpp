#pragma once

#include "pbf/fluid/discretization.hpp"

namespace pbf {

/// Artificial repulsion against the tensile instability, Eq. 13 [MM13]:
///   s(r) = −k (W(r)/W(Δq))ⁿ ,   k = tensile_strength / D_ideal ,   Δq = tensile_distance · h [m²]
/// added to the multipliers of a pair. In the paper k is a raw number; here it is measured in
/// multipliers of the rest lattice, so that it means the same at every resolution.
template <class Kernel>
class TensileCorrection {
 public:
  TensileCorrection(const Kernel& kernel, const Discretization& disc, const SolverParams& solver)
      : k_(solver.tensile_strength / disc.ideal_denominator), n_(solver.tensile_exponent) {
    const Real dq = solver.tensile_distance * disc.h;
    inverse_W_dq_ = 1 / kernel.W(dq * dq);
  }
  /// @param W  the kernel's value at the pair's distance
  [[nodiscard]] Real operator()(Real W) const {
    const Real ratio = W * inverse_W_dq_;
    Real power = ratio;
    for (int k = 1; k < n_; ++k) power *= ratio;
    return -k_ * power;
  }
  [[nodiscard]] bool active() const { return k_ > 0; }

 private:
  Real k_;
  int n_;
  Real inverse_W_dq_;
};

}  // namespace pbf
