#pragma once

#include <cstddef>
#include <cstdint>

namespace pbf::raster {

/// A picture in memory of somebody: a pixel has its red in the lowest byte, then green, blue and
/// alpha. Colors are sRGB-encoded and multiplied by alpha (in linear light), as in the target that
/// the shaders draw into. Row 0 is the bottom one.
struct Picture {
  std::uint32_t* first;
  std::ptrdiff_t pitch;  ///< pixels from one row to the next, less than 0 if that is before it
  int width, height;
  const float* light;  ///< linear, of the 256 values that a color can have
  [[nodiscard]] __attribute__((always_inline)) std::uint32_t* row(int y) const {
    return first + y * pitch;
  }
};

}  // namespace pbf::raster
