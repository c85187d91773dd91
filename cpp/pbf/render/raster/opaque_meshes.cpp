#include "pbf/render/raster/opaque_meshes.hpp"

#include "pbf/core/parallel.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>

namespace pbf::raster {
namespace {

using Vec2d = Eigen::Vector2d;
using Vec3d = Eigen::Vector3d;

/// A triangle as the camera sees it, without what is nearer than the near plane.
struct Facet {
  std::array<Vec2d, 4> corners;  // counter-clockwise [pixels]
  int count = 0;                 // 0: not seen
  Vec3d depth;                   // affine, of a point of the picture: depth · (x, y, 1)
  Vec3 light;
};

Vec3d vec3d(const Triple& t) { return {t.x, t.y, t.z}; }

/// What turns a pixel into the slopes of its ray, or in parallel projection its place [m].
struct Lens {
  bool perspective;
  Vec2d scale, offset;  // slope = scale * pixel + offset
  double near, far;

  explicit Lens(const FrameBlock& frame)
      : perspective(frame.size[2] > 0.5F),
        scale(2.0 * frame.lens[0] / frame.size[0], 2.0 * frame.lens[1] / frame.size[1]),
        offset(-frame.lens[0], -frame.lens[1]),
        near(frame.lens[2]),
        far(frame.lens[3]) {}
  [[nodiscard]] Vec2d pixel_of(const Vec3d& p) const {
    const Vec2d slope = perspective ? Vec2d(p.head<2>() / -p.z()) : Vec2d(p.head<2>());
    return (slope - offset).cwiseQuotient(scale);
  }
};

/// As much light as the floor gets, if it faces up (glsl/opaque_meshes.frag).
Real lit(const Vec3d& normal, const Environment& environment) {
  const Vec3d up = vec3d(environment.up), sun = vec3d(environment.sun);
  const double sky = 0.35 + 0.2 * normal.dot(up);
  return static_cast<Real>(sky +
                           0.45 * std::max(normal.dot(sun), 0.0) / std::max(up.dot(sun), 0.3));
}

/// @param world  the triangle's corners   @param seen  the same in eye space
Facet facet(const std::array<Vec3d, 3>& world,
            const std::array<Vec3d, 3>& seen,
            const Vec3& color,
            const Lens& lens,
            const Environment& environment) {
  Facet result;
  for (int k = 0; k < 3; ++k) {
    const Vec3d &p = seen[k], &q = seen[(k + 1) % 3];
    const double before_p = -p.z() - lens.near, before_q = -q.z() - lens.near;
    if (before_p >= 0) result.corners[result.count++] = lens.pixel_of(p);
    if ((before_p >= 0) != (before_q >= 0)) {
      result.corners[result.count++] =
          lens.pixel_of(p + before_p / (before_p - before_q) * (q - p));
    }
  }
  double area = 0;
  for (int k = 0; k < result.count; ++k) {
    const Vec2d &p = result.corners[k], &q = result.corners[(k + 1) % result.count];
    area += p.x() * q.y() - p.y() * q.x();
  }
  const Vec3d n = (seen[1] - seen[0]).cross(seen[2] - seen[0]);
  const double c = n.dot(seen[0]);
  if (!(area > 0) || !(lens.perspective ? c != 0 : n.z() != 0)) {
    result.count = 0;
    return result;
  }
  // n · (origin + depth direction) = c
  const Vec3d slopes(n.x() * lens.scale.x(), n.y() * lens.scale.y(), n.head<2>().dot(lens.offset));
  result.depth = lens.perspective ? Vec3d((slopes - Vec3d(0, 0, n.z())) / c)
                                  : Vec3d((Vec3d(0, 0, c) - slopes) / n.z());
  const Vec3d outward = (world[1] - world[0]).cross(world[2] - world[0]).normalized();
  result.light = lit(outward, environment) * color;
  return result;
}

/// Columns of pixels whose middles in a row are in the facet: the first, and the one behind the
/// last.
std::array<int, 2> span(const Facet& facet, double y, int width) {
  double left = width, right = 0;
  for (int k = 0; k < facet.count; ++k) {
    const Vec2d &p = facet.corners[k], &q = facet.corners[(k + 1) % facet.count];
    if ((p.y() <= y) == (q.y() <= y)) continue;
    const double x = p.x() + (y - p.y()) / (q.y() - p.y()) * (q.x() - p.x());
    left = std::min(left, x);
    right = std::max(right, x);
  }
  const auto column = [&](double x) {
    return static_cast<int>(std::ceil(std::clamp(x, 0.0, static_cast<double>(width)) - 0.5));
  };
  return {column(left), column(right)};
}

}  // namespace

OpaqueMeshes::OpaqueMeshes(int width, int height)
    : tiles_(width, height),
      depth_(width, height, kNothing),
      red_(width, height, 0),
      green_(width, height, 0),
      blue_(width, height, 0) {}

void OpaqueMeshes::draw(const Meshes& meshes,
                        const Camera& camera,
                        const FrameBlock& frame,
                        const Environment& environment,
                        int threads) {
  const Lens lens(frame);
  const Eigen::Matrix4d view = camera.view().cast<double>();
  const int width = depth_.width(), height = depth_.height();
  tiles_.clear();
  std::vector<Facet> facets;
  for (const auto& mesh : meshes) {
    const auto first = static_cast<Index>(facets.size());
    const auto count = static_cast<Index>(mesh->triangles().size());
    facets.resize(static_cast<std::size_t>(first + count));
    parallel_for(count, threads, [&](Index k) {
      std::array<Vec3d, 3> world, seen;
      for (int corner = 0; corner < 3; ++corner) {
        const auto vertex = mesh->triangles()[static_cast<std::size_t>(k)][corner];
        world[corner] = mesh->vertices().col(vertex).cast<double>();
        seen[corner] = view.topLeftCorner<3, 3>() * world[corner] + view.topRightCorner<3, 1>();
      }
      Facet& result = facets[static_cast<std::size_t>(first + k)];
      result = facet(world, seen, mesh->color(), lens, environment);
      if (result.count == 0) return;
      Vec2d low = result.corners[0], high = low;
      for (int c = 1; c < result.count; ++c) {
        low = low.cwiseMin(result.corners[c]);
        high = high.cwiseMax(result.corners[c]);
      }
      const auto tile = [](double pixel, int size) {
        return static_cast<int>(std::clamp(pixel, 0.0, size - 1.0)) / kTileSide;
      };
      if (high.x() < 0 || high.y() < 0 || low.x() > width || low.y() > height) {
        result.count = 0;
        return;
      }
      for (int row = tile(low.y(), height); row <= tile(high.y(), height); ++row) {
        for (int column = tile(low.x(), width); column <= tile(high.x(), width); ++column) {
          tiles_.mark(column, row);
        }
      }
    });
  }
  const Eigen::Matrix3d rotation = view.topLeftCorner<3, 3>();
  const Vec3d up = vec3d(environment.up);
  const double eye_height = up.dot(vec3d(environment.eye)) - environment.floor_height;
  const Vec3d rise = rotation * up;
  const bool hides = environment.has_floor && eye_height > 0;
  const double farthest = lens.perspective ? 1 / lens.far : -lens.far;
  for (Map* map : {&depth_, &red_, &green_, &blue_}) map->begin(tiles_);
  // A band of tiles is one thread's.
  parallel_chunks(tiles_.rows(), threads, 1, [&](Index band, Index) {
    const int bottom = static_cast<int>(band) * kTileSide;
    const int top = std::min(bottom + kTileSide, height);
    for (int column = 0; column < tiles_.columns(); ++column) {
      if (!tiles_.has(column, static_cast<int>(band))) continue;
      for (int y = bottom; y < bottom + kTileSide; ++y) {
        std::fill_n(depth_.row(y) + column * kTileSide, kTileSide, kNothing);
      }
    }
    for (const Facet& facet : facets) {
      if (facet.count == 0) continue;
      double low = facet.corners[0].y(), high = low;
      for (int c = 1; c < facet.count; ++c) {
        low = std::min(low, facet.corners[c].y());
        high = std::max(high, facet.corners[c].y());
      }
      const int first = std::max(bottom, static_cast<int>(std::clamp(low, -1.0, 1e6)));
      const int last = std::min(top, static_cast<int>(std::clamp(high, -1.0, 1e6)) + 1);
      for (int y = first; y < last; ++y) {
        const auto [begin, end] = span(facet, y + 0.5, width);
        for (int x = begin; x < end; ++x) {
          const double a = facet.depth.dot(Vec3d(x + 0.5, y + 0.5, 1));
          if (!(a > static_cast<double>(depth_.row(y)[x])) || a < farthest) continue;
          const double d = lens.perspective ? 1 / a : -a;
          const Vec2d slope = lens.scale.cwiseProduct(Vec2d(x + 0.5, y + 0.5)) + lens.offset;
          const double spread = lens.perspective ? d : 1;
          const Vec3d p(spread * slope.x(), spread * slope.y(), -d);
          if (hides && eye_height + rise.dot(p) < 0) continue;
          depth_.row(y)[x] = static_cast<float>(a);
          red_.row(y)[x] = facet.light[0];
          green_.row(y)[x] = facet.light[1];
          blue_.row(y)[x] = facet.light[2];
        }
      }
    }
  });
}

}  // namespace pbf::raster
