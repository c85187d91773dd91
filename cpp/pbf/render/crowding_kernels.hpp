#pragma once

#include "pbf/core/isa.hpp"
#include "pbf/neighbors/scan.hpp"

namespace pbf {

/// The inner loops of Crowding, for one instruction set: over the candidates j around a particle at
/// x, which is one of them. Sums are made in the same order with every instruction set.
struct CrowdingKernels {
  /// sum_j u_j^2 of the others.
  float (*sum)(const Candidates& candidates, const Record& x, float inverse_s2);
  /// max_j min(1, 3/2 u_j) m[j], with the particle itself.
  float (*largest)(const Candidates& candidates, const Record& x, float inverse_s2, const float* m);
};

const CrowdingKernels& crowding_kernels(Isa isa);

}  // namespace pbf
