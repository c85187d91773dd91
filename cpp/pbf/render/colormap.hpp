#pragma once

#include "pbf/core/fields.hpp"

#include <bit>
#include <cstdint>

namespace pbf {

/// How a number becomes a color. Of the ordered maps, equal steps in value look like equal steps in
/// color; shuffled gives whole numbers colors that tell neighbors apart.
enum class Colormap { viridis, magma, cividis, coolwarm, gray, shuffled };
template <>
struct Choices<Colormap> {
  static constexpr std::array names{"viridis", "magma", "cividis", "coolwarm", "gray", "shuffled"};
};

/// Least and greatest value of a map: beyond them stays the color of the end.
using ColorRange = std::array<Real, 2>;

/// 0xrrggbb, sRGB-encoded.
using Colors = std::vector<std::uint32_t>;

/// Of linear light.
std::uint32_t encoded_color(const Vec3& linear);

/// In the digits of a float, as glsl/color.glsl reads it.
inline float packed_color(std::uint32_t color) { return std::bit_cast<float>(0x3F000000U | color); }

/// Colors of a map from its least to its greatest value.
inline constexpr int kColormapSize = 256;
const std::array<std::uint32_t, kColormapSize>& table_of(Colormap map);

/// From the least to the greatest of the values; one wide above them if they are all the same.
ColorRange range_of(const ScalarsView& values);

/// @param values  finite   @param range  low < high; shuffled takes none
Colors colors_of(const ScalarsView& values, Colormap map, const ColorRange& range);

}  // namespace pbf
