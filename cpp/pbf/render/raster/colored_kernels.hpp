#pragma once

#include "pbf/core/isa.hpp"
#include "pbf/core/records.hpp"
#include "pbf/render/raster/scene.hpp"
#include "pbf/render/raster/splat_kernels.hpp"

namespace pbf::raster {

/// A tile's first pixels, in maps of one pitch.
struct SphereTile {
  float* depth;      ///< affine, of the nearest sphere
  float* normal[3];  ///< in eye space
  float* color;      ///< packed (glsl/color.glsl)
  std::ptrdiff_t pitch;
};

/// The same of the fluid's color: weight times light, and weight.
struct TintTile {
  float* light[3];
  float* weight;
  std::ptrdiff_t pitch;
};

/// The inner loops over particles with colors, for one instruction set. Records are centers in eye
/// space with packed colors; behind the last there must be kMostLanes that can be read.
struct ColoredKernels {
  /// Opaque spheres (glsl/spheres.frag).
  void (*spheres)(
      const Record* centers, Index count, const SplatView& view, Tile tile, const SphereTile& to);
  /// The fluid's color (glsl/tint.frag).
  /// @param view     of the coarser map
  /// @param surface  affine depth, in the picture's pixels
  /// @param light    linear, of the 256 values that a color can have
  void (*tint)(const Record* centers,
               Index count,
               const SplatView& view,
               const Texels& surface,
               const float* light,
               Tile tile,
               const TintTile& to);
};

const ColoredKernels& colored_kernels(Isa isa);

}  // namespace pbf::raster
