#include "pbf/render/raster/map.hpp"

#include <algorithm>

namespace pbf::raster {

Map::Map(int width, int height, float empty)
    : width_(width), height_(height), empty_(empty), written_(width, height) {
  pitch_ = std::ptrdiff_t{written_.columns()} * kTileSide;
  const std::ptrdiff_t numbers = pitch_ * written_.rows() * kTileSide;
  Line line{};
  std::fill(std::begin(line.values), std::end(line.values), empty);
  // One more in front and one behind.
  lines_.assign(static_cast<std::size_t>(numbers / 16 + 2), line);
  first_ = lines_[1].values;
}

void Map::begin(const Tiles& tiles) {
  for (const Tile& tile : written_.list()) {
    if (tiles.has(tile.x / kTileSide, tile.y / kTileSide)) continue;
    for (int y = tile.y; y < tile.y + kTileSide; ++y) {
      std::fill_n(row(y) + tile.x, kTileSide, empty_);
    }
  }
  written_ = tiles;
}

}  // namespace pbf::raster
