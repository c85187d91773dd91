#include "pbf/render/raster/surroundings.hpp"

#include "pbf/render/affine_depth.hpp"

#include <algorithm>

namespace pbf::raster {

Surroundings surroundings(
    const Map& values, Tile tile, int columns, int rows, std::vector<float>& memory) {
  columns = std::min(columns, values.width());
  rows = std::min(rows, values.height());
  const int pitch = kTileSide + 2 * columns;
  memory.resize(static_cast<std::size_t>(pitch) * (kTileSide + 2 * rows));
  const int first = std::max(tile.x - columns, 0);
  const int last = std::min(tile.x + kTileSide + columns, values.width());
  float* to = memory.data();
  for (int y = tile.y - rows; y < tile.y + kTileSide + rows; ++y, to += pitch) {
    if (y < 0 || y >= values.height()) {
      std::fill_n(to, pitch, kNothing);
      continue;
    }
    float* end = std::fill_n(to, first - (tile.x - columns), kNothing);
    end = std::copy(values.row(y) + first, values.row(y) + last, end);
    std::fill(end, to + pitch, kNothing);
  }
  return {memory.data() + rows * pitch + columns, pitch, columns, rows};
}

}  // namespace pbf::raster
