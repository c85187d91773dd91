#include "pbf/render/colormap.hpp"

#include <algorithm>
#include <cmath>

namespace pbf {
namespace {

using Table = std::array<std::uint32_t, kColormapSize>;

constexpr std::array<Table, Choices<Colormap>::names.size()> kTables{{
#include "pbf/render/colormap_tables.inl"
}};

}  // namespace

std::uint32_t encoded_color(const Vec3& linear) {
  std::uint32_t color = 0;
  for (const Real c : linear) {
    const Real curved = c <= 0.0031308F ? 12.92F * c : 1.055F * std::pow(c, 1 / 2.4F) - 0.055F;
    color = color << 8U | static_cast<std::uint32_t>(std::lround(255 * curved));
  }
  return color;
}

const Table& table_of(Colormap map) { return kTables[static_cast<std::size_t>(map)]; }

ColorRange range_of(const ScalarsView& values) {
  if (values.size() == 0) return {0, 1};
  const Real low = values.minCoeff();
  const Real high = values.maxCoeff();
  // Where 1 is lost in the digits of a float, the next one up.
  return {low, low < high ? high : std::max(low + 1, std::nextafter(low, 3.4e38F))};
}

Colors colors_of(const ScalarsView& values, Colormap map, const ColorRange& range) {
  const Table& table = table_of(map);
  // In double: the share of float32 values in a range of float32 ends is exact enough for 256
  // colors, whatever the range.
  const double low = static_cast<double>(range[0]);
  const double scale = kColormapSize / (static_cast<double>(range[1]) - low);
  Colors colors(static_cast<std::size_t>(values.size()));
  for (Index i = 0; i < values.size(); ++i) {
    const double value = static_cast<double>(values[i]);
    const double place =
        map == Colormap::shuffled
            ? value - kColormapSize * std::floor(std::rint(value) / kColormapSize) + 0.5
            : (value - low) * scale;
    const double last = kColormapSize - 1;
    colors[static_cast<std::size_t>(i)] =
        table[static_cast<std::size_t>(std::clamp(place, 0.0, last))];
  }
  return colors;
}

}  // namespace pbf
