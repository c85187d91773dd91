#pragma once

#include "pbf/core/isa.hpp"
#include "pbf/render/raster/surroundings.hpp"

namespace pbf::raster {

/// One axis of a filter over a layer, as numbers (glsl/smooth.frag).
struct SmoothTerms {
  enum class Kind { bilateral, gaussian, far_side, narrow_range };
  Kind kind;
  bool thickness;  ///< the layer is thickness
  bool perspective;
  bool close_gaps;
  int most_taps;
  float radius;  ///< where the kernel ends [pixels], in perspective at depth 1
  float range;   ///< [m]
  float behind;  ///< [m]
};

/// The inner loops of the separable filters, for one instruction set.
struct SmoothKernels {
  /// Writes the radius [pixels] of each pixel of a tile, 0 for one that stays as it is. Returns the
  /// largest.
  float (*radii)(
      const SmoothTerms& terms, const Map& values, const Map& spheres, Tile tile, float* radius);
  /// Writes the tile's smoothed values to rows as far apart as those of the spheres. The axis is
  /// the one along which there are surroundings.
  /// @param spheres  the tile's first
  void (*smooth)(const SmoothTerms& terms,
                 const Surroundings& around,
                 const float* radius,
                 const float* spheres,
                 float* out,
                 std::ptrdiff_t pitch);
};

const SmoothKernels& smooth_kernels(Isa isa);

}  // namespace pbf::raster
