#pragma once

#include "pbf/core/fields.hpp"

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

/// Colors of a map from its least to its greatest value.
inline constexpr int kColormapSize = 256;
const std::array<std::uint32_t, kColormapSize>& table_of(Colormap map);

/// From the least to the greatest of the values; one wide above them if they are all the same.
ColorRange range_of(const ScalarsView& values);

/// @param values  finite   @param range  low < high; shuffled takes none
Colors colors_of(const ScalarsView& values, Colormap map, const ColorRange& range);

}  // namespace pbf
