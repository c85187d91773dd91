#pragma once

#include "pbf/render/raster/tiles.hpp"

#include <vector>

namespace pbf::raster {

/// A number for every pixel, what an r32f texture is to the passes in glsl/: row 0 is the bottom
/// one. Memory holds whole tiles, so that loops need not stop at the picture's border; what is
/// beyond it may be read and written and means nothing. Rows begin at multiples of 64 bytes, and a
/// vector that begins or ends up to 16 numbers outside of a row can be loaded.
///
/// A pass is a function of this folder with the name of the GLSL pass. It reads maps and writes
/// others in the tiles that hold fluid, one thread to a tile at a time; outside of these a map
/// holds the value `empty`. Numbers are those of the GLSL pass where the arithmetic allows.
class Map {
 public:
  /// @param empty  value where there is no fluid; all of the map until it is written
  Map(int width, int height, float empty);
  Map(Map&&) noexcept = default;
  Map& operator=(Map&&) noexcept = default;

  /// To be called by the pass that is about to write the map: afterwards it is empty outside of the
  /// tiles. Costs only where other tiles were written the last time.
  void begin(const Tiles& tiles);

  // No calls: loops that are compiled for several instruction sets use them.
  [[nodiscard]] __attribute__((always_inline)) int width() const { return width_; }
  [[nodiscard]] __attribute__((always_inline)) int height() const { return height_; }
  /// Numbers from one row to the next.
  [[nodiscard]] __attribute__((always_inline)) std::ptrdiff_t pitch() const { return pitch_; }
  [[nodiscard]] __attribute__((always_inline)) float* row(int y) { return first_ + y * pitch_; }
  [[nodiscard]] __attribute__((always_inline)) const float* row(int y) const {
    return first_ + y * pitch_;
  }

 private:
  struct alignas(64) Line {
    float values[16];
  };
  int width_, height_;
  std::ptrdiff_t pitch_;
  float empty_;
  std::vector<Line> lines_;
  float* first_;
  Tiles written_;
};

}  // namespace pbf::raster
