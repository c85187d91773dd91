#pragma once

#include "pbf/core/isa.hpp"
#include "pbf/neighbors/scan.hpp"

namespace pbf {

/// Sums over the candidates j around a particle at x, r = (x_j - x)/s.
struct Moments {
  float w;                       ///< sum w, the particle's own among them
  float x, y, z;                 ///< sum w r
  float xx, yy, zz, xy, xz, yz;  ///< sum w r r^T
};

/// The inner loop of Anisotropy, for one instruction set. Sums are made in the same order by all.
struct AnisotropyKernels {
  Moments (*moments)(const Candidates& candidates, const Record& x, float inverse_s);
};

const AnisotropyKernels& anisotropy_kernels(Isa isa);

}  // namespace pbf
