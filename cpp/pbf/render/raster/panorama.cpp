#include "pbf/render/raster/panorama.hpp"

#include <algorithm>

namespace pbf::raster {

Panorama::Panorama(const EnvironmentMap& map) {
  Level level{map.width, map.height, {}};
  level.texels.reserve(map.data.size() / 3);
  for (int y = map.height - 1; y >= 0; --y) {
    for (int x = 0; x < map.width; ++x) {
      const auto channel = [&](int c) { return std::min(map.at(x, y)[c], kBrightest); };
      level.texels.push_back({channel(0), channel(1), channel(2), 1});
    }
  }
  levels_.push_back(std::move(level));
  while (levels_.back().width > 1 || levels_.back().height > 1) {
    const Level& fine = levels_.back();
    Level coarse{std::max(fine.width / 2, 1), std::max(fine.height / 2, 1), {}};
    for (int y = 0; y < coarse.height; ++y) {
      for (int x = 0; x < coarse.width; ++x) {
        Record mean{0, 0, 0, 1};
        for (int k = 0; k < 4; ++k) {
          const int column = std::min(2 * x + (k & 1), fine.width - 1);
          const int row = std::min(2 * y + (k >> 1), fine.height - 1);
          const Record& t = fine.texels[static_cast<std::size_t>(row) * fine.width + column];
          mean = {mean.x + t.x / 4, mean.y + t.y / 4, mean.z + t.z / 4, 1};
        }
        coarse.texels.push_back(mean);
      }
    }
    levels_.push_back(std::move(coarse));
  }
}

PanoramaTexels Panorama::texels() const {
  PanoramaTexels result;
  for (const Level& level : levels_) {
    if (result.count == PanoramaTexels::kMostLevels) break;
    result.levels[result.count++] = {&level.texels.front().x, level.width, level.height};
  }
  return result;
}

}  // namespace pbf::raster
