#include "pbf/render/raster/tiles.hpp"

#include <algorithm>

namespace pbf::raster {

Tiles::Tiles(int width, int height)
    : columns_((width + kTileSide - 1) / kTileSide),
      rows_((height + kTileSide - 1) / kTileSide),
      marks_(static_cast<std::size_t>(columns_) * rows_, 0) {}

void Tiles::clear() { std::fill(marks_.begin(), marks_.end(), std::uint8_t{0}); }

void Tiles::mark(int column, int row) {
  std::uint8_t& mark = marks_[static_cast<std::size_t>(row) * columns_ + column];
  __atomic_store_n(&mark, std::uint8_t{1}, __ATOMIC_RELAXED);
}

std::vector<Tile> Tiles::list() const {
  std::vector<Tile> result;
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      if (has(column, row)) result.push_back({column * kTileSide, row * kTileSide});
    }
  }
  return result;
}

}  // namespace pbf::raster
