#pragma once

#include "pbf/render/raster/map.hpp"

namespace pbf::raster {

/// The values of a tile and around it, in memory of their own: neighbors along a column do not
/// compete for the same few lines of the cache, and nothing ends at the picture's border. What is
/// beyond that is kNothing.
struct Surroundings {
  const float* first;    ///< the tile's first pixel
  std::ptrdiff_t pitch;  ///< numbers from row to row
  int columns, rows;     ///< how far to the sides, above and below
};

/// Copies them to `memory`; at most the extent of the map to each side.
Surroundings surroundings(
    const Map& values, Tile tile, int columns, int rows, std::vector<float>& memory);

}  // namespace pbf::raster
