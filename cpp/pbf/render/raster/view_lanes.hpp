#pragma once

#include "pbf/render/raster/frame_lanes.hpp"

namespace pbf::PBF_ISA_NAMESPACE {

/// kLanes pixels of a row: their middles, and the rays to them.
struct View {
  Lanes x, y;
  Vec3Lanes direction;  // unit vector, eye space
};
PBF_INLINE View view_of(const FrameTerms& frame, int x, int y) {
  const Lanes column = to_lanes(lane_numbers() + x) + Lanes(0.5F);
  const Lanes row = static_cast<float>(y) + 0.5F;
  return {column, row, normalize(ray_direction(frame, column, row))};
}

/// A map's numbers at these pixels.
PBF_INLINE Lanes load_at(const raster::Texels& from, int x, int y) {
  return load_lanes(from.first + y * from.pitch + x);
}
PBF_INLINE Vec3Lanes load_at(const raster::Texels (&from)[3], int x, int y) {
  return {load_at(from[0], x, y), load_at(from[1], x, y), load_at(from[2], x, y)};
}

/// Calls f(x, y) for each vector of a tile's pixels that are in the picture.
template <class F>
PBF_INLINE void for_pixels(raster::Tile tile, int width, int height, F&& f) {
  for (int y = tile.y; y < tile.y + raster::kTileSide && y < height; ++y) {
    for (int x = tile.x; x < tile.x + raster::kTileSide && x < width; x += kLanes) f(x, y);
  }
}

}  // namespace pbf::PBF_ISA_NAMESPACE
