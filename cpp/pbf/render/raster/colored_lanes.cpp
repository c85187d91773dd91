// Compiled once per instruction set (cpp/pbf_render.cmake).
#include "pbf/render/raster/colored_kernels.hpp"
#include "pbf/render/raster/frame_lanes.hpp"
#include "pbf/render/raster/outline_lanes.hpp"

namespace pbf::PBF_ISA_NAMESPACE {
namespace {

using namespace raster;

/// Where rays enter a sphere, and how long they are in it (glsl/sphere_hit.glsl).
struct Hit {
  Lanes front, chord;
  Mask seen;
};
PBF_INLINE Hit
hit_sphere(const SplatView& view, Lanes px, Lanes py, const Vec3Lanes& center, float radius) {
  const Vec3Lanes beside{px, py, 0.0F}, ahead{0.0F, 0.0F, -1.0F};
  const Vec3Lanes direction = view.perspective ? beside + ahead : ahead;
  const Vec3Lanes to_center = view.perspective ? center : center - beside;
  const Lanes scale2 = dot(direction, direction);
  const Lanes middle = dot(direction, to_center) / scale2;
  const Vec3Lanes miss = to_center - middle * direction;
  const Lanes half2 = Lanes(radius * radius) - dot(miss, miss);
  const Lanes half_depth = sqrt(max(half2, 0.0F) / scale2);
  const Lanes front = middle - half_depth;
  const Lanes inside = min(middle + half_depth, view.far) - max(front, view.near);
  return {front, inside * sqrt(scale2), (half2 > Lanes(0.0F)) & (inside > Lanes(0.0F))};
}

/// Calls f(number, center, x, y, px, py) for each vector of pixels that a sphere may cover.
template <class F>
PBF_INLINE void for_covered(
    const Record* centers, Index count, const SplatView& view, Tile tile, const Rays& rays, F&& f) {
  for (Index i = 0; i < count; i += kLanes) {
    const RecordLanes c = load_records(centers + i);
    const PixelBox box = box_in(outline(view, c.xyz, view.radius), tile);
    const int lanes = count - i < kLanes ? static_cast<int>(count - i) : kLanes;
    for (int lane = 0; lane < lanes; ++lane) {
      const Vec3Lanes center{c.xyz.x.v[lane], c.xyz.y.v[lane], c.xyz.z.v[lane]};
      for (int y = box.bottom[lane]; y < box.top[lane]; ++y) {
        for (int x = box.left[lane]; x < box.right[lane]; x += kLanes) {
          f(i + lane, center, x, y, load_lanes(rays.x + x), Lanes(rays.y[y]));
        }
      }
    }
  }
}

void spheres(
    const Record* centers, Index count, const SplatView& view, Tile tile, const SphereTile& to) {
  alignas(64) float depth[kTileSide * kWidth];
  alignas(64) std::int32_t nearest[kTileSide * kWidth];
  for (float& a : depth) a = kNothing;
  for (std::int32_t& number : nearest) number = 0;
  const Rays rays(view, tile);
  for_covered(centers, count, view, tile, rays,
              [&](Index number, const Vec3Lanes& center, int x, int y, Lanes px, Lanes py)
                  PBF_LAMBDA_INLINE {
                    const Hit hit = hit_sphere(view, px, py, center, view.radius);
                    const Mask seen = hit.seen & (Lanes(view.near) <= hit.front);
                    if (!any(seen)) return;
                    const int at = y * kWidth + x;
                    const Lanes before = load_lanes(depth + at);
                    const Lanes a = select(
                        seen, view.perspective ? Lanes(1) / hit.front : -hit.front, kNothing);
                    const Mask nearer = a > before;
                    store(depth + at, select(nearer, a, before));
                    const Ints known = load<Ints>(nearest + at);
                    const Ints own = static_cast<std::int32_t>(number) - Ints{};
                    const Ints now = nearer.v ? own : known;
                    std::memcpy(nearest + at, &now, sizeof now);
                  });
  for (int y = 0; y < kTileSide; ++y) {
    for (int x = 0; x < kTileSide; x += kLanes) {
      const std::ptrdiff_t at = y * to.pitch + x;
      const Lanes a = load_lanes(depth + y * kWidth + x);
      const Mask exists = is_surface(a);
      Vec3Lanes n{0.0F, 0.0F, 0.0F};
      Lanes color = 0.0F;
      if (any(exists)) {
        const std::int32_t* number = nearest + y * kWidth + x;
        const RecordLanes sphere =
            records_at([&](int lane) PBF_LAMBDA_INLINE { return centers + number[lane]; });
        const Lanes d = depth_of(view, a);
        const Lanes spread = view.perspective ? d : Lanes(1);
        const Vec3Lanes p{spread * load_lanes(rays.x + x), spread * Lanes(rays.y[y]), -d};
        n = select(exists, Lanes(1 / view.radius) * (p - sphere.xyz), n);
        color = select(exists, sphere.w, 0.0F);
      }
      store(to.depth + at, a);
      store(to.normal[0] + at, n.x);
      store(to.normal[1] + at, n.y);
      store(to.normal[2] + at, n.z);
      store(to.color + at, color);
    }
  }
}

/// Depth of the surface at the pixels of a coarser map: the front of the pixels around; where there
/// is none, far in front of everything.
PBF_INLINE Lanes surface_around(const SplatView& view, const Texels& surface, int x, int y) {
  const auto low = [](Lanes at, float size, int texels) PBF_LAMBDA_INLINE {
    const Lanes place = at * Lanes(static_cast<float>(texels) / size) - Lanes(0.5F);
    return clamp(to_ints(place), 0, texels - 1);
  };
  const Ints left = low(to_lanes(lane_numbers() + x) + Lanes(0.5F), view.width, surface.width);
  const Ints below = low(static_cast<float>(y) + 0.5F, view.height, surface.height);
  const Ints right = clamp(left + 1, 0, surface.width - 1);
  const Ints above = clamp(below + 1, 0, surface.height - 1);
  const Lanes a = max(max(fetch(surface, left, below), fetch(surface, right, above)),
                      max(fetch(surface, left, above), fetch(surface, right, below)));
  const Lanes d = depth_of(view, a);
  return select(is_surface(a), d, -kNowhere);
}

void tint(const Record* centers,
          Index count,
          const SplatView& view,
          const Texels& surface,
          const float* light,
          Tile tile,
          const TintTile& to) {
  constexpr float kDeepest = 5;  // behind the surface [radii]
  alignas(64) float front[kTileSide * kWidth];
  alignas(64) float sums[4][kTileSide * kWidth];
  for (auto& sum : sums) {
    for (float& number : sum) number = 0;
  }
  for (int y = 0; y < kTileSide; ++y) {
    for (int x = 0; x < kWidth; x += kLanes) {
      store(front + y * kWidth + x, surface_around(view, surface, tile.x + x, tile.y + y));
    }
  }
  const Lanes inverse(1 / view.radius);
  for_covered(centers, count, view, tile, Rays(view, tile),
              [&](Index number, const Vec3Lanes& center, int x, int y, Lanes px, Lanes py)
                  PBF_LAMBDA_INLINE {
                    const int at = y * kWidth + x;
                    const Lanes surface_depth = load_lanes(front + at);
                    const Lanes deepest = surface_depth + Lanes(kDeepest * view.radius);
                    if (!any(-center.z - Lanes(view.radius) < deepest)) return;
                    const Hit hit = hit_sphere(view, px, py, center, view.radius);
                    const Mask counts = hit.seen & (hit.front < deepest);
                    if (!any(counts)) return;
                    const Lanes behind = (hit.front - surface_depth) * inverse;
                    const Lanes near = smoothstep(-1.25F, -0.75F, behind);
                    const Lanes weight =
                        select(counts, hit.chord * inverse * near * exp(-max(behind, 0.0F)), 0.0F);
                    std::uint32_t color;
                    std::memcpy(&color, &centers[number].w, sizeof color);
                    const auto add = [&](int k, Lanes value) PBF_LAMBDA_INLINE {
                      store(sums[k] + at, load_lanes(sums[k] + at) + value);
                    };
                    add(0, weight * Lanes(light[color >> 16 & 255]));
                    add(1, weight * Lanes(light[color >> 8 & 255]));
                    add(2, weight * Lanes(light[color & 255]));
                    add(3, weight);
                  });
  float* const out[4] = {to.light[0], to.light[1], to.light[2], to.weight};
  for (int k = 0; k < 4; ++k) {
    for (int y = 0; y < kTileSide; ++y) {
      std::memcpy(out[k] + y * to.pitch, sums[k] + y * kWidth, kTileSide * sizeof(float));
    }
  }
}

}  // namespace

const ColoredKernels& colored_kernels() {
  static constexpr ColoredKernels kernels{spheres, tint};
  return kernels;
}

}  // namespace pbf::PBF_ISA_NAMESPACE
