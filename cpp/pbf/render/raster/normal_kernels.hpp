#pragma once

#include "pbf/core/isa.hpp"
#include "pbf/render/raster/scene.hpp"
#include "pbf/render/raster/tiles.hpp"

namespace pbf::raster {

/// The uniforms of glsl/normal.frag.
struct NormalTerms {
  FrameTerms frame;
  Texels depth, spheres;             ///< affine depth; that of the spheres, with crowding
  float range, radius, drop_radius;  ///< [m]
};

/// The inner loop of the normals, for one instruction set.
struct NormalKernels {
  /// Writes those of a tile to rows that are as far apart as those of the depth.
  void (*normal)(const NormalTerms& terms, Tile tile, float* x, float* y, float* z);
};

const NormalKernels& normal_kernels(Isa isa);

}  // namespace pbf::raster
