#pragma once

#include "pbf/render/colormap.hpp"
#include "pbf/render/image.hpp"

#include <string>
#include <vector>

namespace pbf {

/// Numbers along a color bar: multiples of 1, 2 or 5 times a power of ten.
struct Ticks {
  struct Tick {
    double value;
    std::string text;  ///< of value / 10^exponent, UTF-8
  };
  std::vector<Tick> ticks;  ///< 3 to 7 of them within the range, in order
  int exponent = 0;         ///< other than 0 where the numbers would be long
};
Ticks ticks_of(const ColorRange& range);

/// Draws the color bar with its numbers and what they are of into the picture's upper right corner,
/// as large as a 1/65 of the picture's height for a capital letter makes it.
/// @param label  UTF-8, such as "speed [m/s]"
void draw_legend(Image& image, const std::string& label, Colormap map, const ColorRange& range);

}  // namespace pbf
