// Compiled once per instruction set (cpp/pbf_render.cmake). The formulas are those of
// glsl/normal.frag, where they are explained.
#include "pbf/render/raster/frame_lanes.hpp"
#include "pbf/render/raster/normal_kernels.hpp"

namespace pbf::PBF_ISA_NAMESPACE {
namespace {

using raster::kTileSide;
using raster::NormalKernels;
using raster::NormalTerms;
using raster::Tile;

constexpr float kMostReach = 64;  // of a ring [pixels]

struct Point {
  Vec3Lanes at;  // in eye space [m]
  Mask exists;
};

/// The surface at kLanes pixels of a row, beside the picture too.
PBF_INLINE Point position(const NormalTerms& terms, int x, int y) {
  const auto& depth = terms.depth;
  const Lanes column = to_lanes(lane_numbers() + x) + Lanes(0.5F);
  const bool inside = y >= 0 && y < depth.height;
  const Lanes a = inside ? load_lanes(depth.first + y * depth.pitch + x) : Lanes(0.0F);
  const Mask exists = is_surface(a) & (column > Lanes(0.0F)) &
                      (column < Lanes(static_cast<float>(inside ? depth.width : 0)));
  const Lanes d = select(exists, depth_of(terms.frame, a), 1.0F);
  return {eye_position(terms.frame, column, static_cast<float>(y) + 0.5F, d), exists};
}

struct Tangent {
  Vec3Lanes along, step;
  Mask ends, lone;
};

PBF_INLINE Tangent
tangent(const NormalTerms& terms, int x, int y, int dx, int dy, const Vec3Lanes& p, Lanes reach) {
  const Point to_next = position(terms, x + dx, y + dy);
  const Point from_previous = position(terms, x - dx, y - dy);
  const Mask has_next = to_next.exists, has_previous = from_previous.exists;
  const Vec3Lanes next = to_next.at - p, previous = p - from_previous.at;
  const Lanes width = pixel_at(terms.frame, -p.z), floor2 = width * width;
  const auto weight = [&](Mask exists, const Vec3Lanes& step) PBF_LAMBDA_INLINE {
    return select(exists, floor2 / (step.z * step.z + floor2), 0.0F);
  };
  const Lanes w_next = weight(has_next, next), w_previous = weight(has_previous, previous);
  const Lanes high = min(abs(next.z), abs(previous.z));
  const Mask alone = ~has_next & ~has_previous;
  const Mask both = has_next & has_previous;
  const Mask strand = both & (next.z * previous.z <= Lanes(0.0F)) & (high > Lanes(terms.range));
  const Mask on_next = has_next & (abs(next.z) < reach);
  const Mask on_previous = has_previous & (abs(previous.z) < reach);
  const Vec3Lanes sum = (w_next * w_next) * next + (w_previous * w_previous) * previous;
  const Vec3Lanes axis{static_cast<float>(dx), static_cast<float>(dy), 0.0F};
  return {select(strand | alone, axis, sum), select(w_next > w_previous, next, -previous),
          ~(on_next & on_previous), ~(on_next | on_previous)};
}

PBF_INLINE Vec3Lanes sphere_normal(const Vec3Lanes& a, const Vec3Lanes& b, const Vec3Lanes& view) {
  const Vec3Lanes across = cross(a, b);
  const Lanes across2 = dot(across, across);
  const Vec3Lanes c = (Lanes(0.5F) / across2) * cross(dot(a, a) * b - dot(b, b) * a, across);
  const Lanes height2 = Lanes(1) - dot(c, c);
  const Lanes side = select(dot(across, view) > Lanes(0.0F), -1.0F, 1.0F);
  const Vec3Lanes n = (side / sqrt(across2)) * across;
  const Vec3Lanes own = sqrt(max(height2, 0.0F)) * n - c;
  return select(height2 > Lanes(0.0F), own, Vec3Lanes{0.0F, 0.0F, 0.0F});
}

/// What eight neighbors and the pixel say.
struct Ring {
  Lanes count = 1.0F, rise = 0.0F;
  Lanes x = 0.0F, y = 0.0F, slope_x = 0.0F, slope_y = 0.0F;
  Lanes xx = 0.0F, xy = 0.0F, yy = 0.0F;
  Lanes gone_x = 0.0F, gone_y = 0.0F;

  /// @param dx, dy  to the neighbor [pixels]
  /// @param u       the difference of affine depth in that to another surface
  PBF_INLINE void add(Lanes dx, Lanes dy, Lanes difference, Lanes u) {
    const Lanes u2 = u * u, keep = max(Lanes(1) - u2, 0.0F), weight = keep * keep;
    count += weight;
    rise += weight * difference;
    x += weight * dx;
    y += weight * dy;
    slope_x += difference * (weight * dx);
    slope_y += difference * (weight * dy);
    xx += weight * dx * dx;
    xy += weight * dx * dy;
    yy += weight * dy * dy;
    const Lanes gone = select(difference < Lanes(0.0F), min(u2 * u2, 1.0F), 0.0F);
    gone_x += gone * dx;
    gone_y += gone * dy;
  }
};

/// @param n      by differences
/// @param reach  a sprite's radius [pixels]
PBF_INLINE Vec3Lanes rim_normal(
    const NormalTerms& terms, int x, int y, const Vec3Lanes& p, const Vec3Lanes& n, Ints reach) {
  constexpr float kMiddleAtOutline = 0.57F;
  const FrameTerms& frame = terms.frame;
  const bool perspective = frame.perspective;
  const auto& depth = terms.depth;
  const Ints column = lane_numbers() + x, row = Ints{} + y;
  const Lanes a = load_lanes(depth.first + y * depth.pitch + x);
  const Lanes down = Lanes(1) / farther(perspective, a, terms.range);
  const Lanes up = Lanes(1) / nearer(perspective, a, terms.range);
  Ring ring;
  const auto add = [&](Ints dx, Ints dy) PBF_LAMBDA_INLINE {
    const Ints at_x = clamp(column + dx, 0, depth.width - 1);
    const Ints at_y = clamp(row + dy, 0, depth.height - 1);
    const Lanes difference = fetch(depth, at_x, at_y) - a;
    ring.add(to_lanes(at_x - column), to_lanes(at_y - row), difference,
             max(difference * up, -difference * down));
  };
  const Ints beside = (7 * reach + 5) / 10, none{};
  add(reach, none);
  add(beside, beside);
  add(none, reach);
  add(-beside, beside);
  add(-reach, none);
  add(-beside, -beside);
  add(none, -reach);
  add(beside, -beside);
  const Lanes gone = sqrt(ring.gone_x * ring.gone_x + ring.gone_y * ring.gone_y);
  if (!any(gone > Lanes(0.0F))) return n;
  const Lanes middle_x = ring.x / ring.count, middle_y = ring.y / ring.count;
  const Lanes xx = ring.xx - ring.x * middle_x, xy = ring.xy - ring.x * middle_y;
  const Lanes yy = ring.yy - ring.y * middle_y;
  const Lanes slope_x = ring.slope_x - ring.rise * middle_x;
  const Lanes slope_y = ring.slope_y - ring.rise * middle_y;
  const Lanes determinant = xx * yy - xy * xy;
  const Lanes radius = to_lanes(reach), radius2 = radius * radius;
  const Lanes known = smoothstep(0.05F, 0.3F, determinant / (radius2 * radius2));
  const Mask wanted = (known > Lanes(0.0F)) & (gone > Lanes(0.0F));
  if (!any(wanted)) return n;
  const Lanes inverse = Lanes(1) / select(wanted, determinant, 1.0F);
  const Lanes rise_x = (yy * slope_x - xy * slope_y) * inverse;  // to the next pixels
  const Lanes rise_y = (xx * slope_y - xy * slope_x) * inverse;
  const Lanes at_x = to_lanes(column) + Lanes(0.5F), at_y = to_lanes(row) + Lanes(0.5F);
  const Vec3Lanes right =
      eye_position(frame, at_x + Lanes(1), at_y, depth_of(frame, a + rise_x)) - p;
  const Vec3Lanes above =
      eye_position(frame, at_x, at_y + Lanes(1), depth_of(frame, a + rise_y)) - p;
  const Lanes per_radius(1 / terms.radius);
  const Vec3Lanes plane = normalize(cross(per_radius * right, per_radius * above));
  const Vec3Lanes view = normalize(ray_direction(frame, at_x, at_y));
  Lanes cosine = clamp(-dot(plane, view), 0.0F, 1.0F);
  const Vec3Lanes tilt = plane + cosine * view;
  // A plane that faces the viewer tilts nowhere.
  const Vec3Lanes across = (Lanes(1) / max(sqrt(dot(tilt, tilt)), 1e-6F)) * tilt;
  const Lanes inwards =
      max(-(middle_x * ring.gone_x + middle_y * ring.gone_y) / gone, 0.0F) / radius;
  const Lanes to_outline =
      max(Lanes(1) - inwards * Lanes(1 / kMiddleAtOutline), Lanes(0.5F) / radius);
  cosine *= sqrt(to_outline / (to_outline + inwards));
  const Vec3Lanes own = sqrt(Lanes(1) - cosine * cosine) * across - cosine * view;
  return select(wanted, normalize(mix(n, own, known * min(gone / radius, 1.0F))), n);
}

void normal(const NormalTerms& terms, Tile tile, float* nx, float* ny, float* nz) {
  const std::ptrdiff_t pitch = terms.depth.pitch;
  for (int y = tile.y; y < tile.y + kTileSide; ++y) {
    for (int x = tile.x; x < tile.x + kTileSide; x += kLanes) {
      const std::ptrdiff_t at = y * pitch + x;
      const Point point = position(terms, x, y);
      Vec3Lanes n{0.0F, 0.0F, 0.0F};
      if (any(point.exists)) {
        const Vec3Lanes& p = point.at;
        const Lanes sphere = load_lanes(terms.spheres.first + at);
        const Lanes radius = mix(terms.drop_radius, terms.radius, crowding_of(sphere));
        const Tangent right = tangent(terms, x, y, 1, 0, p, radius);
        const Tangent up = tangent(terms, x, y, 0, 1, p, radius);
        n = normalize(cross(normalize(right.along), normalize(up.along)));
        const Mask outline =
            point.exists & ~is_body(sphere) & (right.ends | up.ends) & ~right.lone & ~up.lone;
        if (any(outline)) {
          const Vec3Lanes view =
              terms.frame.perspective ? (Lanes(-1) / p.z) * p : Vec3Lanes{0.0F, 0.0F, -1.0F};
          const Lanes per_radius = Lanes(1) / radius;
          const Vec3Lanes own = sphere_normal(per_radius * right.step, per_radius * up.step, view);
          n = select(outline & (dot(own, view) < Lanes(0.0F)), own, n);
        }
        const Lanes pixels = min(terms.radius / pixel_at(terms.frame, -p.z), kMostReach);
        const Ints reach = to_ints(pixels);
        const Mask has_rim = point.exists & is_body(sphere) & (Lanes(2) <= to_lanes(reach));
        // Where nobody tells drops from bodies, every sphere may be alone.
        if (terms.drop_radius < terms.radius && any(has_rim)) {
          n = select(has_rim, rim_normal(terms, x, y, p, n, reach), n);
        }
        n = select(point.exists, n, Vec3Lanes{0.0F, 0.0F, 0.0F});
      }
      const std::ptrdiff_t to = (y - tile.y) * pitch + (x - tile.x);
      store(nx + to, n.x);
      store(ny + to, n.y);
      store(nz + to, n.z);
    }
  }
}

}  // namespace

const NormalKernels& normal_kernels() {
  static constexpr NormalKernels kernels{normal};
  return kernels;
}

}  // namespace pbf::PBF_ISA_NAMESPACE
