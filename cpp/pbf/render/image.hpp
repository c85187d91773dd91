#pragma once

#include <cstdint>
#include <vector>

namespace pbf {

/// Values of width * height pixels, `channels` each; row 0 is the top one.
template <class T>
struct Pixels {
  int width = 0, height = 0, channels = 1;
  std::vector<T> data;
  [[nodiscard]] const T* at(int x, int y) const {
    return data.data() + (static_cast<std::size_t>(y) * width + x) * channels;
  }
};

/// RGBA: sRGB-encoded colors, not multiplied by alpha.
using Image = Pixels<std::uint8_t>;

/// What the picture is made from.
struct Layers {
  Pixels<float> depth;         ///< front of the nearest sprite along the viewing axis [m], 0: none
  Pixels<float> depth_smooth;  ///< [m], 0: none
  Pixels<float> thickness;     ///< [m]
  Pixels<float> thickness_smooth;  ///< [m]
  Pixels<float> normal;            ///< three channels, eye space, towards the viewer; 0: none
};

}  // namespace pbf
