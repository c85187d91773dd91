#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pbf::raster {

/// Side of the squares that the picture is worked off in [pixels].
inline constexpr int kTileSide = 32;

/// A square of the picture, by its lower left pixel.
struct Tile {
  int x, y;
};

/// The squares of the picture in which there may be fluid: what a pass has to work off. At the
/// right and upper border they reach beyond the picture.
class Tiles {
 public:
  Tiles(int width, int height);
  void clear();
  /// Adds a square; again is harmless, and so are several threads.
  void mark(int column, int row);

  [[nodiscard]] int columns() const { return columns_; }
  [[nodiscard]] int rows() const { return rows_; }
  [[nodiscard]] bool has(int column, int row) const {
    return marks_[static_cast<std::size_t>(row) * columns_ + column] != 0;
  }
  /// All that were marked, row by row.
  [[nodiscard]] std::vector<Tile> list() const;

 private:
  int columns_, rows_;
  std::vector<std::uint8_t> marks_;
};

}  // namespace pbf::raster
