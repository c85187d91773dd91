#pragma once

#include "pbf/render/raster/splats.hpp"

#include <vector>

namespace pbf::test {

/// What sphere_depth writes, row 0 below.
struct DrawnSplats {
  std::vector<float> depth, thickness, back;
  bool operator==(const DrawnSplats&) const = default;
};

/// By the passes in C++.
/// @param stretches  of ellipsoids; null: spheres
inline DrawnSplats draw_splats(const Records& particles,
                               const Record* stretches,
                               const FrameBlock& frame,
                               int width,
                               int height,
                               const RenderParams& params,
                               int threads) {
  const raster::SplatView view = raster::splat_view(frame, params);
  raster::Splats splats;
  raster::Map depth(width, height, kNothing), thickness(width, height, 0);
  raster::Map back(width, height, kNothing);
  splats.bin(particles.data(), particles.size(), view, threads, stretches);
  splats.draw(view, depth, thickness, back, threads);
  const auto numbers = [](const raster::Map& map) {
    std::vector<float> all;
    for (int y = 0; y < map.height(); ++y) {
      all.insert(all.end(), map.row(y), map.row(y) + map.width());
    }
    return all;
  };
  return {numbers(depth), numbers(thickness), numbers(back)};
}

}  // namespace pbf::test
