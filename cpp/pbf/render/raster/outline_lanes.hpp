#pragma once

#include "pbf/render/raster/ellipsoid_lanes.hpp"
#include "pbf/render/raster/frame_lanes.hpp"

// glsl/sphere_outline.glsl: what is seen of spheres and ellipsoids.
namespace pbf::PBF_ISA_NAMESPACE {

using raster::kTileSide;
using raster::SplatView;

/// What is seen of a sphere [pixels].
struct Outline {
  Lanes left, right, bottom, top;
  Mask visible;
};

struct Interval {
  Lanes low, high;
};

/// Least and greatest slope x/depth of the part of a circle (center x, depth z) that lies beyond
/// the near plane, seen from the origin: tangents, or where the circle meets the plane [MMG13].
PBF_INLINE Interval slopes(Lanes x, Lanes z, Lanes radius, Lanes near) {
  const Lanes cut = sqrt(max(radius * radius - (near - z) * (near - z), 0.0F));
  Interval result{(x - cut) / near, (x + cut) / near};
  const Lanes length2 = x * x + z * z;
  const Lanes t = sqrt(max(length2 - radius * radius, 0.0F));
  const Mask outside = t > Lanes(0.0F);
  const Lanes low_along = z * t + x * radius;
  const Lanes high_along = z * t - x * radius;
  const Lanes in_front = near * length2;
  const auto beyond = [&](Lanes along) PBF_LAMBDA_INLINE { return in_front <= along * t; };
  result.low = select(outside & beyond(low_along), (x * t - z * radius) / low_along, result.low);
  result.high =
      select(outside & beyond(high_along), (x * t + z * radius) / high_along, result.high);
  return result;
}

PBF_INLINE Lanes radius_of(const SplatView& view, Lanes crowding) {
  return view.drop_radius * (1.0F - crowding) + view.radius * crowding;
}

/// The same of an ellipsoid of all center + v with v^T A^-1 v <= 1, by its center and A: the planes
/// through the origin that touch it are x = s z with (x - s z)^2 = xx - 2 s xz + s^2 zz.
PBF_INLINE Interval slopes(Lanes x, Lanes z, Lanes xx, Lanes zz, Lanes xz) {
  // Squares of differences of what is near to one another would lose the digits that matter.
  const Lanes root =
      sqrt(max(z * z * xx - 2.0F * (x * z) * xz + x * x * zz - (xx * zz - xz * xz), 0.0F));
  const Lanes middle = x * z - xz, inverse = 1.0F / (z * z - zz);
  return {(middle - root) * inverse, (middle + root) * inverse};
}

PBF_INLINE Outline outline(const SplatView& view, Interval x, Interval y, Lanes z, Lanes reach) {
  // A hundredth of a pixel of margin for rounding; beyond the picture there is nothing to draw.
  const auto pixel = [](Lanes slope, float half_size, float pixels, float margin)
                         PBF_LAMBDA_INLINE {
                           const Lanes at = (slope / half_size + 1.0F) * (0.5F * pixels);
                           return clamp(at + margin, 0.0F, pixels);
                         };
  return {pixel(x.low, view.half_width, view.width, -0.01F),
          pixel(x.high, view.half_width, view.width, 0.01F),
          pixel(y.low, view.half_height, view.height, -0.01F),
          pixel(y.high, view.half_height, view.height, 0.01F),
          (z + reach > view.near) & (z - reach < view.far)};
}

PBF_INLINE Outline outline(const SplatView& view, const Vec3Lanes& center, Lanes radius) {
  const Lanes z = -center.z;
  if (!view.perspective) {
    return outline(view, {center.x - radius, center.x + radius},
                   {center.y - radius, center.y + radius}, z, radius);
  }
  return outline(view, slopes(center.x, z, radius, view.near),
                 slopes(center.y, z, radius, view.near), z, radius);
}

/// Of the ellipsoid that `stretch` makes of the sphere.
PBF_INLINE Outline outline(const SplatView& view,
                           const Vec3Lanes& center,
                           Lanes radius,
                           const Symmetric& stretch) {
  const Symmetric unit = squared(stretch);
  const Lanes r2 = radius * radius, z = -center.z;
  const Lanes xx = r2 * unit.xx, yy = r2 * unit.yy, zz = r2 * unit.zz;
  const Lanes half_x = sqrt(xx), half_y = sqrt(yy), half_z = sqrt(zz);
  if (!view.perspective) {
    return outline(view, {center.x - half_x, center.x + half_x},
                   {center.y - half_y, center.y + half_y}, z, half_z);
  }
  Interval x = slopes(center.x, z, xx, zz, -r2 * unit.xz);
  Interval y = slopes(center.y, z, yy, zz, -r2 * unit.yz);
  const Mask cut = z - half_z < Lanes(view.near);
  if (any(cut)) {  // by the near plane: a sphere around it
    const Lanes around = sqrt(xx + yy + zz);
    const Interval sphere_x = slopes(center.x, z, around, view.near);
    const Interval sphere_y = slopes(center.y, z, around, view.near);
    x = {select(cut, sphere_x.low, x.low), select(cut, sphere_x.high, x.high)};
    y = {select(cut, sphere_y.low, y.low), select(cut, sphere_y.high, y.high)};
  }
  return outline(view, x, y, z, half_z);
}

/// The first pixel whose center is not below an image coordinate.
PBF_INLINE Ints first_pixel(Lanes at) {
  // Coordinates are not negative: truncating rounds down.
  return __builtin_convertvector((at + 0.5F).v, Ints);
}

/// Pixels of a tile, from left and bottom to before right and top.
struct PixelBox {
  Ints left, right, bottom, top;
};
PBF_INLINE PixelBox box_in(const Outline& at, raster::Tile tile) {
  const auto inside = [](Ints pixel, int low)
                          PBF_LAMBDA_INLINE { return clamp(pixel - low, 0, kTileSide); };
  return {inside(first_pixel(at.left), tile.x), inside(first_pixel(at.right), tile.x),
          inside(first_pixel(at.bottom), tile.y), inside(first_pixel(at.top), tile.y)};
}

/// Vectors may begin at any pixel of the tile.
inline constexpr int kWidth = kTileSide + kLanes;

/// A tile's pixels: x and y of the rays through their middles.
struct Rays {
  alignas(64) float x[kWidth];
  float y[kTileSide];
  PBF_INLINE Rays(const SplatView& view, raster::Tile tile) {
    const auto fill = [](float* at, int count, int first, float pixels, float half)
                          PBF_LAMBDA_INLINE {
                            for (int k = 0; k < count; ++k) {
                              const float pixel = static_cast<float>(first + k) + 0.5F;
                              at[k] = (2.0F * pixel * (1.0F / pixels) - 1.0F) * half;
                            }
                          };
    fill(x, kWidth, tile.x, view.width, view.half_width);
    fill(y, kTileSide, tile.y, view.height, view.half_height);
  }
};

}  // namespace pbf::PBF_ISA_NAMESPACE
