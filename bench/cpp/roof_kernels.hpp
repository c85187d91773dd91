#pragma once

#include "pbf/core/records.hpp"

#include <cstdint>

namespace pbf::bench {

/// The loops that roof.cpp times, compiled for one instruction set. A loop returns what its work
/// comes to, so that none of it can be left out.
struct RoofKernels {
  /// `rounds` times a multiply-add x ← x · a + b in each of several independent chains.
  float (*fused)(std::int64_t rounds, float a, float b);
  double fused_flops;  ///< of a round
  /// As many chains, half of multiplications, half of additions: what is left of the peak when the
  /// two may not be fused, as in the solver (docs/determinism.md).
  float (*separate)(std::int64_t rounds, float a, float b);
  double separate_flops;

  /// a[k] = b[k] + s · c[k] for k in [0, n), the triad of STREAM [McC95].
  void (*triad)(std::int64_t n, float s, const float* b, const float* c, float* a);
  /// Loads the records that the `count` entries name, each four times a record's place, and turns
  /// them into vectors of x, y, z and w, a record per lane: the solver's own gather(). `count` is a
  /// multiple of 16.
  float (*load_records)(const Record* records, const std::uint32_t* entries, std::int64_t count);
  /// The same by gather instructions; null where there are none.
  float (*gather_records)(const Record* records,
                          const std::uint32_t* entries,
                          std::int64_t count) = nullptr;
};

}  // namespace pbf::bench
