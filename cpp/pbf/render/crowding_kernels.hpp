#pragma once

#include "pbf/core/isa.hpp"
#include "pbf/neighbors/scan.hpp"

namespace pbf {

/// The inner loops of Crowding, for one instruction set: over the candidates j around a particle at
/// x, which is one of them. Sums are made in the same order with every instruction set.
struct CrowdingKernels {
  /// Whether a particle with flags[j] set is so close that this one is as crowded.
  bool (*is_beside)(const Candidates& candidates,
                    const Record& x,
                    float inverse_s2,
                    const std::uint8_t* flags);
  /// m of the particle, without itself; writes the u_j.
  float (*sum)(const Candidates& candidates, const Record& x, float inverse_s2, float* u);
  /// Sets flags[j] where u_j is larger than this.
  void (*mark)(const Candidates& candidates, const float* u, float beyond, std::uint8_t* flags);
  /// max_j min(1, 3/2 u_j) m[j], with the particle itself.
  float (*largest)(const Candidates& candidates, const Record& x, float inverse_s2, const float* m);
};

/// m_i of a particle in a body of fluid.
inline constexpr float kBodySum = 9;
/// A particle with u_ij above this is as crowded as a j in a body.
inline constexpr float kBodyShare = 2.0F / 3;

const CrowdingKernels& crowding_kernels(Isa isa);

}  // namespace pbf
