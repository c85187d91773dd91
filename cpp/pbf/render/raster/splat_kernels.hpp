#pragma once

#include "pbf/core/isa.hpp"
#include "pbf/core/records.hpp"
#include "pbf/render/raster/scene.hpp"
#include "pbf/render/raster/tiles.hpp"

#include <cstdint>

namespace pbf::raster {

/// The uniforms of glsl/sprite.vert, and those of the frame.
struct SplatView : FrameTerms {
  float radius, drop_radius;  ///< [m]
  float volume;               ///< of a particle [m³]
};

/// Tiles that a sprite covers, the last ones included; none if the first column exceeds the last.
struct TileBox {
  std::int16_t first_column, last_column, first_row, last_row;
};

/// The inner loops of Splats, for one instruction set.
struct SplatKernels {
  /// Eye-space centers with their crowding, and the tiles they cover, of the particles
  /// [first, last). May write kMostLanes more.
  /// @param stretches  of ellipsoids (Anisotropy), which become those in eye space; null: spheres
  void (*project)(const Record* particles,
                  Record* stretches,
                  Index first,
                  Index last,
                  const SplatView& view,
                  Record* centers,
                  TileBox* boxes);
  /// Draws sprites into a tile of the maps. Behind the last sprite there must be kMostLanes that
  /// can be read.
  /// @param stretches  in eye space; null: spheres
  /// @param depth, thickness, back  the tile's first pixel
  void (*draw)(const Record* centers,
               const Record* stretches,
               Index count,
               const SplatView& view,
               Tile tile,
               float* depth,
               float* thickness,
               float* back,
               std::ptrdiff_t pitch);
};

const SplatKernels& splat_kernels(Isa isa);

}  // namespace pbf::raster
