// Compiled once per instruction set (cpp/pbf_render.cmake).
#include "pbf/render/affine_depth.hpp"
#include "pbf/render/raster/outline_lanes.hpp"

namespace pbf::PBF_ISA_NAMESPACE {
namespace {

using namespace raster;

void project(const Record* particles,
             Record* stretches,
             Index first,
             Index last,
             const SplatView& view,
             Record* centers,
             TileBox* boxes) {
  const float* m = view.view;
  for (Index i = first; i < last; i += kLanes) {
    const RecordLanes p = load_records(particles + i);
    const Vec3Lanes center = eye_space(view, p.xyz);
    store_records(centers + i, center, p.w);
    Outline at;
    if (stretches == nullptr) {
      at = outline(view, center, radius_of(view, p.w));
    } else {
      const Symmetric stretch = turned(load_symmetric(stretches + 2 * i), m);
      store_symmetric(stretches + 2 * i, stretch);
      at = outline(view, center, radius_of(view, p.w), stretch);
    }
    const Ints left = first_pixel(at.left), right = first_pixel(at.right);
    const Ints bottom = first_pixel(at.bottom), top = first_pixel(at.top);
    for (int lane = 0; lane < kLanes; ++lane) {
      const bool covers =
          at.visible.v[lane] != 0 && left[lane] < right[lane] && bottom[lane] < top[lane];
      const auto tile = [](int pixel) { return static_cast<std::int16_t>(pixel / kTileSide); };
      boxes[i + lane] = covers ? TileBox{tile(left[lane]), tile(right[lane] - 1),
                                         tile(bottom[lane]), tile(top[lane] - 1)}
                               : TileBox{1, 0, 1, 0};
    }
  }
}

struct Workspace : Rays {
  using Rays::Rays;
  alignas(64) float depth[kTileSide * kWidth];
  alignas(64) float thickness[kTileSide * kWidth];
  alignas(64) float back[kTileSide * kWidth];      // depth [m], 0: none
  alignas(64) float inverse2[kTileSide * kWidth];  // 1 / |direction|²
  alignas(64) float length[kTileSide * kWidth];    // |direction|
};

struct Sprite {
  float x, y, z, radius, share;
  std::uint32_t level;
  int left, right, bottom, top;
};

/// From where it is an ellipsoid to where it is a sphere: the matrix column by column, and the
/// center there.
struct ToSphere {
  Vec3Lanes x, y, z, center;
};

/// A ray, given by x and y of its direction (perspective) or of its origin, against a sprite: the
/// depth nearest to the center, how far the center is from there squared, and 1 / |direction|², the
/// latter two as they are where the sprite is a sphere.
struct Miss {
  Lanes middle, distance2, inverse2;
};
template <bool kPerspective>
PBF_INLINE Miss miss(const ToSphere& to, Lanes px, Lanes py) {
  Vec3Lanes direction = Lanes(-1.0F) * to.z, center = to.center;
  const Vec3Lanes shift = px * to.x + py * to.y;
  (kPerspective ? direction : center) += kPerspective ? shift : Lanes(-1.0F) * shift;
  const Lanes inverse2 = 1.0F / dot(direction, direction);
  const Lanes middle = dot(direction, center) * inverse2;
  const Vec3Lanes beside = center - middle * direction;
  return {middle, dot(beside, beside), inverse2};
}

template <bool kPerspective, bool kStretched>
void splat(const Sprite& s, const ToSphere& to_sphere, const SplatView& view, Workspace& to) {
  const Lanes radius2 = s.radius * s.radius;
  const Ints level = static_cast<std::int32_t>(s.level) - Ints{};
  const Lanes farthest = s.level < 3 ? view.far : 0.0F;  // drops alone have no far side
  for (int y = s.bottom; y < s.top; ++y) {
    const Lanes py = to.y[y];
    for (int x = s.left; x < s.right; x += kLanes) {
      const int at = y * kWidth + x;
      const Lanes px = load_lanes(to.x + x);
      Lanes middle, miss2, inverse2;
      if constexpr (kStretched) {
        const Miss found = miss<kPerspective>(to_sphere, px, py);
        middle = found.middle;
        miss2 = found.distance2;
        inverse2 = found.inverse2;
      } else if (kPerspective) {
        inverse2 = load_lanes(to.inverse2 + at);
        middle = (px * s.x + py * s.y - s.z) * inverse2;
        const Vec3Lanes miss{s.x - middle * px, s.y - middle * py, s.z + middle};
        miss2 = dot(miss, miss);
      } else {
        inverse2 = 1.0F;
        middle = -s.z;
        const Lanes mx = s.x - px, my = s.y - py;
        miss2 = mx * mx + my * my;
      }
      const Lanes half2 = radius2 - miss2;
      const Mask hit = half2 > Lanes(0.0F);
      if (!any(hit)) continue;
      const Lanes half_depth = sqrt(max(half2, 0.0F) * inverse2);
      const Lanes front = middle - half_depth;
      const Lanes back = middle + half_depth;
      const Lanes inside = min(back, view.far) - max(front, view.near);
      const Lanes chord = kPerspective ? inside * load_lanes(to.length + at) : inside;
      store(to.thickness + at,
            load_lanes(to.thickness + at) + max(select(hit, chord, 0.0F), 0.0F) * s.share);
      store(to.back + at, max(load_lanes(to.back + at), select(hit, min(back, farthest), 0.0F)));
      const Mask seen = hit & (chord > Lanes(0.0F)) & (Lanes(view.near) <= front);
      const Lanes affine = kPerspective ? 1.0F / front : -front;
      const Ints bits = (reinterpret_cast<Ints>(affine.v) & ~3) | level;
      const Lanes value = select(seen, Lanes(reinterpret_cast<Lanes::Vector>(bits)), kNothing);
      store(to.depth + at, max(value, load_lanes(to.depth + at)));
    }
  }
}

template <bool kPerspective, bool kStretched>
void draw_tile(const Record* centers,
               [[maybe_unused]] const Record* stretches,
               Index count,
               const SplatView& view,
               Tile tile,
               float* depth,
               float* thickness,
               float* back,
               std::ptrdiff_t pitch) {
  Workspace work(view, tile);
  for (int y = 0; y < kTileSide; ++y) {
    for (int x = 0; x < kWidth; x += kLanes) {
      const int at = y * kWidth + x;
      store(work.thickness + at, 0.0F);
      store(work.depth + at, kNothing);
      store(work.back + at, 0.0F);
      const Lanes px = load_lanes(work.x + x), py = work.y[y];
      const Lanes length2 = px * px + py * py + 1.0F;
      store(work.inverse2 + at, 1.0F / length2);
      store(work.length + at, sqrt(length2));
    }
  }
  for (Index i = 0; i < count; i += kLanes) {
    const RecordLanes c = load_records(centers + i);
    const Lanes radius = radius_of(view, c.w);
    Outline at;
    Symmetric inverse;
    Vec3Lanes center;
    if constexpr (kStretched) {
      const Symmetric stretch = load_symmetric(stretches + 2 * i);
      at = outline(view, c.xyz, radius, stretch);
      inverse = adjugate(stretch);
      center = inverse * c.xyz;
    } else {
      at = outline(view, c.xyz, radius);
    }
    const PixelBox box = box_in(at, tile);
    const Lanes share = view.volume / (4.18879020F * radius * radius * radius);
    const Ints level = __builtin_convertvector((3.5F - 3.0F * c.w).v, Ints);
    const int lanes = count - i < kLanes ? static_cast<int>(count - i) : kLanes;
    for (int lane = 0; lane < lanes; ++lane) {
      const Sprite sprite{c.xyz.x.v[lane], c.xyz.y.v[lane], c.xyz.z.v[lane],
                          radius.v[lane],  share.v[lane],   static_cast<std::uint32_t>(level[lane]),
                          box.left[lane],  box.right[lane], box.bottom[lane],
                          box.top[lane]};
      ToSphere to;
      if constexpr (kStretched) {
        const auto of = [&](Lanes x, Lanes y, Lanes z) PBF_LAMBDA_INLINE {
          return Vec3Lanes{x.v[lane], y.v[lane], z.v[lane]};
        };
        to = {of(inverse.xx, inverse.xy, inverse.xz), of(inverse.xy, inverse.yy, inverse.yz),
              of(inverse.xz, inverse.yz, inverse.zz), of(center.x, center.y, center.z)};
      }
      splat<kPerspective, kStretched>(sprite, to, view, work);
    }
  }
  for (int y = 0; y < kTileSide; ++y) {
    std::memcpy(thickness + y * pitch, work.thickness + y * kWidth, kTileSide * sizeof(float));
    std::memcpy(depth + y * pitch, work.depth + y * kWidth, kTileSide * sizeof(float));
    for (int x = 0; x < kTileSide; x += kLanes) {
      const Lanes at = load_lanes(work.back + y * kWidth + x);
      const Lanes affine = kPerspective ? 1.0F / at : -at;
      store(back + y * pitch + x, select(at > Lanes(0.0F), affine, kNothing));
    }
  }
}

template <bool kStretched>
auto tile_loop(bool perspective) {
  return perspective ? draw_tile<true, kStretched> : draw_tile<false, kStretched>;
}

void draw(const Record* centers,
          const Record* stretches,
          Index count,
          const SplatView& view,
          Tile tile,
          float* depth,
          float* thickness,
          float* back,
          std::ptrdiff_t pitch) {
  const auto loop = stretches != nullptr ? tile_loop<true> : tile_loop<false>;
  loop(view.perspective)(centers, stretches, count, view, tile, depth, thickness, back, pitch);
}

}  // namespace

const raster::SplatKernels& splat_kernels() {
  static constexpr SplatKernels table{project, draw};
  return table;
}

}  // namespace pbf::PBF_ISA_NAMESPACE
