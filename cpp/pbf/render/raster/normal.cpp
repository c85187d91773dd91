#include "pbf/render/raster/normal.hpp"

#include "pbf/core/parallel.hpp"
#include "pbf/render/frame_block.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

namespace pbf::raster {
namespace {

using Vec2 = Eigen::Matrix<Real, 2, 1>;

bool is_surface(float a) { return a > 0.1F * kNothing; }

/// As glsl/frame.glsl has it.
float crowding_of(float a) {
  return 1 - static_cast<float>(std::bit_cast<std::uint32_t>(a) & 3U) / 3;
}

/// How much affine depth changes by a length (glsl/frame.glsl).
float farther(bool perspective, float a, float length) {
  return perspective ? a * a * length / (1 + a * length) : length;
}
float nearer(bool perspective, float a, float length) {
  const float share = std::min(a * length, 0.5F);
  return perspective ? a * share / (1 - share) : length;
}

/// The surface along an axis of the picture: towards the next pixel; from the pixel to the neighbor
/// of the smaller step of depth; whether there is none on one of the sides, or only another one,
/// and whether on neither.
struct Tangent {
  Vec3 along, step;
  bool ends, lone;
};

/// Normal of the sphere of a radius through a point and two more, at steps a and b from it: their
/// circle's center lies at c, the sphere's behind it as seen along `view`. 0 if there is none.
Vec3 sphere_normal(const Vec3& a, const Vec3& b, const Vec3& view, Real radius) {
  const Vec3 across = a.cross(b);
  const Vec3 c =
      (a.squaredNorm() * b - b.squaredNorm() * a).cross(across) / (2 * across.squaredNorm());
  const Real height2 = radius * radius - c.squaredNorm();
  if (!(height2 > 0)) return Vec3::Zero();
  const Vec3 n = across.dot(view) > 0 ? Vec3(-across) : across;
  return (std::sqrt(height2) * n.normalized() - c) / radius;
}

/// What eight neighbors around and the pixel say (glsl/normal.frag).
struct Ring {
  float count = 1, rise = 0;
  Vec2 sum = Vec2::Zero(), slope = Vec2::Zero();
  Vec3 spread = Vec3::Zero();  // xx, xy, yy
  Vec2 gone = Vec2::Zero();

  /// @param u  the difference of affine depth in that to another surface
  void add(const Vec2& x, float difference, float u) {
    const float keep = std::max(1 - u * u, 0.0F);
    const float weight = keep * keep;
    count += weight;
    rise += weight * difference;
    sum += weight * x;
    slope += weight * difference * x;
    spread += weight * Vec3(x.x() * x.x(), x.x() * x.y(), x.y() * x.y());
    if (difference < 0) gone += std::min(u * u * u * u, 1.0F) * x;
  }
};

constexpr float kMostReach = 64;           // of a ring [pixels]
constexpr float kMiddleAtOutline = 0.57F;  // in the ring's radius

/// The surface at the pixels of a picture (glsl/normal.frag).
class SurfaceOf {
 public:
  SurfaceOf(const Map& depth, const Map& spheres, const Camera& camera, const RenderParams& params)
      : depth_(depth),
        spheres_(spheres),
        range_(params.smoothing_range_in_force()),
        radius_(params.radius),
        drop_radius_(params.drop_radius_in_force()),
        frame_(frame_block(camera, depth.width(), depth.height())),
        perspective_(!camera.orthographic) {}

  [[nodiscard]] bool exists(int x, int y) const {
    return x >= 0 && y >= 0 && x < depth_.width() && y < depth_.height() &&
           is_surface(depth_.row(y)[x]);
  }
  [[nodiscard]] Vec3 normal(int x, int y) const {
    const Vec3 p = position(x, y);
    const Real crowding = crowding_of(spheres_.row(y)[x]);
    const Real radius = drop_radius_ * (1 - crowding) + radius_ * crowding;
    const Tangent right = tangent(x, y, 1, 0, p, radius);
    const Tangent up = tangent(x, y, 0, 1, p, radius);
    const Vec3 n = right.along.cross(up.along).normalized();
    if (crowding > 0.5F) {
      const auto reach = static_cast<int>(std::min(radius_ / width(p), kMostReach));
      const bool is_body = drop_radius_ < radius_;  // nobody knows otherwise
      return is_body && reach > 1 ? rim_normal(x, y, p, n, reach) : n;
    }
    if (!(right.ends || up.ends) || right.lone || up.lone) return n;
    const Vec3 view = direction(p);
    const Vec3 own = sphere_normal(right.step, up.step, view, radius);
    return own.dot(view) < 0 ? own : n;
  }

 private:
  /// Of a viewing ray.
  [[nodiscard]] Vec3 direction(const Vec3& p) const {
    return perspective_ ? Vec3(p / -p.z()) : Vec3(0, 0, -1);
  }
  /// Of a pixel [m].
  [[nodiscard]] Real width(const Vec3& p) const {
    return (perspective_ ? -p.z() : 1) / frame_.size[3];
  }
  /// In eye space [m].
  [[nodiscard]] Vec3 position(int x, int y) const { return position(x, y, depth_.row(y)[x]); }
  [[nodiscard]] Vec3 position(int x, int y, float a) const {
    const float d = perspective_ ? 1 / a : -a;
    const auto slope = [](int pixel, float size, float half) {
      return (2 * (static_cast<float>(pixel) + 0.5F) / size - 1) * half;
    };
    const float spread = perspective_ ? d : 1;
    return {spread * slope(x, frame_.size[0], frame_.lens[0]),
            spread * slope(y, frame_.size[1], frame_.lens[1]), -d};
  }
  /// The differences to both sides, weighted by 1/(dz² + pixel²)². What is alone faces the viewer,
  /// a strand or a groove of one pixel too.
  /// @param reach  a step of depth that is higher leads to another sphere [m]
  [[nodiscard]] Tangent tangent(int x, int y, int dx, int dy, const Vec3& p, Real reach) const {
    const bool has_next = exists(x + dx, y + dy);
    const bool has_previous = exists(x - dx, y - dy);
    const Vec3 next = has_next ? Vec3(position(x + dx, y + dy) - p) : Vec3::Zero();
    const Vec3 previous = has_previous ? Vec3(p - position(x - dx, y - dy)) : Vec3::Zero();
    const auto weight = [&](bool exists, const Vec3& step) {
      return exists ? 1 / (step.z() * step.z() + width(p) * width(p)) : 0;
    };
    const float w_next = weight(has_next, next), w_previous = weight(has_previous, previous);
    const bool on_next = has_next && std::abs(next.z()) < reach;
    const bool on_previous = has_previous && std::abs(previous.z()) < reach;
    const bool is_strand = has_next && has_previous && next.z() * previous.z() <= 0 &&
                           std::min(std::abs(next.z()), std::abs(previous.z())) > range_;
    Vec3 along = w_next * w_next * next + w_previous * w_previous * previous;
    if (is_strand || (!has_next && !has_previous)) {
      along = Vec3(static_cast<Real>(dx), static_cast<Real>(dy), 0);
    }
    return {along.normalized(), w_next > w_previous ? next : Vec3(-previous),
            !(on_next && on_previous), !(on_next || on_previous)};
  }

  /// Where a body of fluid ends within a sprite's radius: that of the plane that fits the neighbors
  /// best, tilted as much more as the pixel is nearer to the outline than their middle.
  /// @param n      by differences
  /// @param reach  a sprite's radius [pixels]
  [[nodiscard]] Vec3 rim_normal(int x, int y, const Vec3& p, const Vec3& n, int reach) const {
    const float a = depth_.row(y)[x];
    const float down = farther(perspective_, a, range_), up = nearer(perspective_, a, range_);
    Ring ring;
    const auto add = [&](int dx, int dy) {
      const int at_x = std::clamp(x + dx, 0, depth_.width() - 1);
      const int at_y = std::clamp(y + dy, 0, depth_.height() - 1);
      const float difference = depth_.row(at_y)[at_x] - a;
      ring.add(Vec2(static_cast<Real>(at_x - x), static_cast<Real>(at_y - y)), difference,
               difference / (difference > 0 ? up : down));
    };
    const int beside = (7 * reach + 5) / 10;
    for (const auto& [cosine, sine] : {std::pair{1, 0}, {0, 1}, {-1, 0}, {0, -1}}) {
      add(cosine * reach, sine * reach);
      add((cosine - sine) * beside, (cosine + sine) * beside);
    }
    const Vec2 middle = ring.sum / ring.count;
    const Real xx = ring.spread.x() - ring.sum.x() * middle.x();
    const Real xy = ring.spread.y() - ring.sum.x() * middle.y();
    const Real yy = ring.spread.z() - ring.sum.y() * middle.y();
    const Vec2 slope = ring.slope - ring.rise * middle;
    const Real determinant = xx * yy - xy * xy;
    const Real gone = ring.gone.norm();
    const auto radius = static_cast<Real>(reach);
    const Real certain = determinant / (radius * radius * radius * radius);
    const Real t = std::clamp((certain - 0.05F) / 0.25F, Real{0}, Real{1});
    const Real known = t * t * (3 - 2 * t);
    if (known == 0 || gone == 0) return n;
    const Vec2 rise = Vec2(yy * slope.x() - xy * slope.y(), xx * slope.y() - xy * slope.x()) /
                      determinant;  // to the next pixels
    const Vec3 plane = (position(x + 1, y, a + rise.x()) - p)
                           .cross(position(x, y + 1, a + rise.y()) - p)
                           .normalized();
    const Vec3 view = direction(p).normalized();
    Real cosine = std::clamp(-plane.dot(view), Real{0}, Real{1});
    const Vec3 across = (plane + cosine * view).normalized();
    const Real inwards = std::max(-middle.dot(ring.gone) / gone, Real{0}) / radius;
    const Real to_outline = std::max(1 - inwards / kMiddleAtOutline, 0.5F / radius);
    cosine *= std::sqrt(to_outline / (to_outline + inwards));
    const Vec3 own = std::sqrt(1 - cosine * cosine) * across - cosine * view;
    const Real share = known * std::min(gone / radius, Real{1});
    return ((1 - share) * n + share * own).normalized();
  }

  const Map& depth_;
  const Map& spheres_;
  Real range_, radius_, drop_radius_;  // [m]
  FrameBlock frame_;
  bool perspective_;
};

}  // namespace

Pixels<float> normal(const Map& depth,
                     const Map& spheres,
                     const Tiles& tiles,
                     const Camera& camera,
                     const RenderParams& params,
                     int threads) {
  Pixels<float> result{depth.width(), depth.height(), 3, {}};
  result.data.resize(static_cast<std::size_t>(result.width) * result.height * 3);
  const SurfaceOf surface(depth, spheres, camera, params);
  const std::vector<Tile> list = tiles.list();
  parallel_chunks(static_cast<Index>(list.size()), threads, 1, [&](Index first, Index) {
    const Tile tile = list[static_cast<std::size_t>(first)];
    for (int y = tile.y; y < std::min(tile.y + kTileSide, depth.height()); ++y) {
      for (int x = tile.x; x < std::min(tile.x + kTileSide, depth.width()); ++x) {
        if (!surface.exists(x, y)) continue;
        const int row = result.height - 1 - y;
        Eigen::Map<Vec3>(&result.data[3 * (static_cast<std::size_t>(row) * result.width + x)]) =
            surface.normal(x, y);
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
