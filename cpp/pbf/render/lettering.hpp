#pragma once

#include "pbf/render/image.hpp"

#include <string_view>

namespace pbf {

/// Letters as an engineer's stencil draws them, strokes of one width with round ends, so that they
/// are sharp at any size and need no font file. Latin letters, digits, the signs of numbers and
/// units, superscripts; what is not there is drawn as a box.
///
/// Sizes are those of a capital's height [pixels].

/// @param text  UTF-8
double width_of(std::string_view text, double size);

/// @param x, y  left end of the baseline [pixels], y down from the top of the image
/// @param color  0xrrggbb, sRGB
void draw_text(
    Image& image, std::string_view text, double x, double y, double size, std::uint32_t color);

/// Lays a color over a pixel; outside of the image nothing happens.
/// @param share  0 leaves the pixel as it is, 1 replaces it
void blend(Image& image, int x, int y, std::uint32_t color, double share);

}  // namespace pbf
