#include "pbf/render/passes/fluid_tiles.hpp"

#include "pbf/render/raster/splats.hpp"

namespace pbf {

FluidTiles::FluidTiles(int width, int height) : buffer_(GL_ARRAY_BUFFER), reached_(width, height) {
  array_.instances(buffer_, 3, 0);
}

void FluidTiles::find(const PointsView& positions, const FrameBlock& frame, Real radius) {
  reached_.clear();
  raster::mark_tiles(positions, radius, frame, reached_);
  upload(reached_);
}

void FluidTiles::find(const Records& centers,
                      const Records& stretches,
                      const FrameBlock& frame,
                      Real radius) {
  reached_.clear();
  raster::mark_tiles(centers, stretches, radius, frame, reached_);
  upload(reached_);
}

void FluidTiles::upload(const raster::Tiles& tiles) {
  std::vector<float> corners;
  for (const raster::Tile& tile : tiles.list()) {
    for (const int value : {tile.x, tile.y, kSide}) corners.push_back(static_cast<float>(value));
  }
  count_ = static_cast<GLsizei>(corners.size() / 3);
  buffer_.upload(corners.data(), static_cast<GLsizeiptr>(corners.size() * sizeof(float)));
}

void FluidTiles::draw(Blend blend) const {
  set_draw_state(blend);
  array_.bind();
  if (count_ > 0) glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, count_);
}

}  // namespace pbf
