#include "pbf/render/passes/fluid_tiles.hpp"

#include <algorithm>
#include <cmath>

namespace pbf {
namespace {

struct Span {
  int first, last;
};

/// Tiles between two image coordinates in [-1, 1] across `pixels` pixels, a pixel of margin on each
/// side.
Span tiles_between(float low, float high, int pixels, int tiles) {
  const auto tile = [&](float ndc, float margin) {
    const float pixel = (0.5F * std::clamp(ndc, -2.0F, 2.0F) + 0.5F) * static_cast<float>(pixels);
    return static_cast<int>(std::floor((pixel + margin) / FluidTiles::kSide));
  };
  return {std::max(tile(low, -1.0F), 0), std::min(tile(high, 1.0F), tiles - 1)};
}

}  // namespace

FluidTiles::FluidTiles(int width, int height)
    : width_(width), height_(height), buffer_(GL_ARRAY_BUFFER), reached_(width, height) {
  array_.instances(buffer_, 3, 0);
}

void FluidTiles::find(const PointsView& positions, const Camera& camera, Real radius) {
  reached_.clear();
  const Eigen::Matrix4f view = camera.view();
  const float half_height = camera.half_height();
  const float half_width = half_height * static_cast<float>(width_) / static_cast<float>(height_);
  for (Index i = 0; i < positions.cols(); ++i) {
    const Vec3 center = view.topLeftCorner<3, 3>() * positions.col(i) + view.topRightCorner<3, 1>();
    const float nearest = -center.z() - radius;
    const float farthest = -center.z() + radius;
    if (farthest <= camera.near || nearest >= camera.far) continue;
    const float near = std::max(nearest, camera.near);
    // The box around the sphere, projected: its outermost slopes are at its near or its far side.
    const auto span = [&](float at, float half_size, int pixels, int tiles) {
      float low = at - radius;
      float high = at + radius;
      if (!camera.orthographic) {
        low /= low < 0 ? near : farthest;
        high /= high > 0 ? near : farthest;
      }
      return tiles_between(low / half_size, high / half_size, pixels, tiles);
    };
    const Span x = span(center.x(), half_width, width_, reached_.columns());
    const Span y = span(center.y(), half_height, height_, reached_.rows());
    for (int row = y.first; row <= y.last; ++row) {
      for (int column = x.first; column <= x.last; ++column) reached_.mark(column, row);
    }
  }
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
