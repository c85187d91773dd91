#include "pbf/render/raster/normal.hpp"

#include "pbf/core/parallel.hpp"
#include "pbf/render/frame_block.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace pbf::raster {
namespace {

bool is_surface(float a) { return a > 0.1F * kNothing; }

/// The surface at the pixels of a picture (glsl/normal.frag).
class SurfaceOf {
 public:
  SurfaceOf(const Map& depth, const Camera& camera, Real range)
      : depth_(depth),
        range_(range),
        frame_(frame_block(camera, depth.width(), depth.height())),
        perspective_(!camera.orthographic) {}

  [[nodiscard]] bool exists(int x, int y) const {
    return x >= 0 && y >= 0 && x < depth_.width() && y < depth_.height() &&
           is_surface(depth_.row(y)[x]);
  }
  /// In eye space [m].
  [[nodiscard]] Vec3 position(int x, int y) const {
    const float a = depth_.row(y)[x];
    const float d = perspective_ ? 1 / a : -a;
    const auto slope = [](int pixel, float size, float half) {
      return (2 * (static_cast<float>(pixel) + 0.5F) / size - 1) * half;
    };
    const float spread = perspective_ ? d : 1;
    return {spread * slope(x, frame_.size[0], frame_.lens[0]),
            spread * slope(y, frame_.size[1], frame_.lens[1]), -d};
  }
  /// Along the step to the next pixel: the differences to both sides, weighted by
  /// 1/(dz² + pixel²)². What is alone faces the viewer, a strand or a groove of one pixel too.
  [[nodiscard]] Vec3 tangent(int x, int y, int dx, int dy, const Vec3& p) const {
    const float width = (perspective_ ? -p.z() : 1) / frame_.size[3];  // of a pixel [m]
    const auto weighted = [&](const Vec3& step) {
      const float w = 1 / (step.z() * step.z() + width * width);
      return Vec3(w * w * step);
    };
    const bool has_next = exists(x + dx, y + dy);
    const bool has_previous = exists(x - dx, y - dy);
    const Vec3 alone(static_cast<Real>(dx), static_cast<Real>(dy), 0);
    if (!has_next && !has_previous) return alone;
    const Vec3 next = has_next ? Vec3(position(x + dx, y + dy) - p) : Vec3::Zero();
    const Vec3 previous = has_previous ? Vec3(p - position(x - dx, y - dy)) : Vec3::Zero();
    const bool is_strand = has_next && has_previous && next.z() * previous.z() <= 0 &&
                           std::min(std::abs(next.z()), std::abs(previous.z())) > range_;
    if (is_strand) return alone;
    Vec3 sum = Vec3::Zero();
    if (has_next) sum += weighted(next);
    if (has_previous) sum += weighted(previous);
    return sum.normalized();
  }

 private:
  const Map& depth_;
  Real range_;  // [m]
  FrameBlock frame_;
  bool perspective_;
};

}  // namespace

Pixels<float> normal(
    const Map& depth, const Tiles& tiles, const Camera& camera, Real range, int threads) {
  Pixels<float> result{depth.width(), depth.height(), 3, {}};
  result.data.resize(static_cast<std::size_t>(result.width) * result.height * 3);
  const SurfaceOf surface(depth, camera, range);
  const std::vector<Tile> list = tiles.list();
  parallel_chunks(static_cast<Index>(list.size()), threads, 1, [&](Index first, Index) {
    const Tile tile = list[static_cast<std::size_t>(first)];
    for (int y = tile.y; y < std::min(tile.y + kTileSide, depth.height()); ++y) {
      for (int x = tile.x; x < std::min(tile.x + kTileSide, depth.width()); ++x) {
        if (!surface.exists(x, y)) continue;
        const Vec3 p = surface.position(x, y);
        const Vec3 n = surface.tangent(x, y, 1, 0, p).cross(surface.tangent(x, y, 0, 1, p));
        const int row = result.height - 1 - y;
        Eigen::Map<Vec3>(&result.data[3 * (static_cast<std::size_t>(row) * result.width + x)]) =
            n.normalized();
      }
    }
  });
  return result;
}

Pixels<float> pixels(const Map& map) {
  Pixels<float> result{map.width(), map.height(), 1, {}};
  result.data.reserve(static_cast<std::size_t>(result.width) * result.height);
  for (int y = result.height - 1; y >= 0; --y) {
    result.data.insert(result.data.end(), map.row(y), map.row(y) + result.width);
  }
  return result;
}

Pixels<float> depth_pixels(const Map& map, const Camera& camera) {
  Pixels<float> result = pixels(map);
  for (float& a : result.data) a = !is_surface(a) ? 0 : camera.orthographic ? -a : 1 / a;
  return result;
}

}  // namespace pbf::raster
