#pragma once

#include "pbf/render/affine_depth.hpp"
#include "pbf/render/raster/glsl_lanes.hpp"

/// Of glsl/frame.glsl, where it is explained, what the loops over pixels need.
namespace pbf::PBF_ISA_NAMESPACE {

inline constexpr float kNowhere = 1e30F;  // how far it is to what a ray does not meet [m]
PBF_INLINE Mask is_met(Lanes way) { return way < Lanes(1e29F); }

using raster::FrameTerms;

PBF_INLINE Lanes crowding_of(Lanes a) {
  const auto level = reinterpret_cast<Mask::Vector>(a.v) & 3;
  return Lanes(1) - Lanes(__builtin_convertvector(level, Lanes::Vector)) / Lanes(3);
}

PBF_INLINE Lanes with_crowding_of(Lanes a, Lanes sphere) {
  const auto level = reinterpret_cast<Mask::Vector>(sphere.v) & 3;
  return Lanes(reinterpret_cast<Lanes::Vector>((reinterpret_cast<Mask::Vector>(a.v) & ~3) | level));
}
inline constexpr int kDrop = 2;
PBF_INLINE Mask is_body(Lanes a) {
  return Mask{(reinterpret_cast<Mask::Vector>(a.v) & kDrop) == 0};
}

PBF_INLINE Lanes smoothing_share(Lanes a) { return crowding_of(a) * crowding_of(a); }

PBF_INLINE Lanes farther(bool perspective, Lanes a, float length) {
  if (!perspective) return Lanes(length);
  return a * a * Lanes(length) / (Lanes(1) + a * Lanes(length));
}
PBF_INLINE Lanes nearer(bool perspective, Lanes a, float length) {
  if (!perspective) return Lanes(length);
  const Lanes share = min(a * Lanes(length), Lanes(0.5F));
  return a * share / (Lanes(1) - share);
}

/// Of a far side there may be none, which is as far as can be to either side.
PBF_INLINE Mask is_surface(Lanes a) { return abs(a) < Lanes(-kLeastSurface); }
PBF_INLINE Lanes depth_of(const FrameTerms& frame, Lanes a) {
  return frame.perspective ? Lanes(1) / a : -a;
}

PBF_INLINE Lanes slope(Lanes pixel, float size, float half) {
  return (Lanes(2) * pixel * Lanes(1 / size) - Lanes(1)) * Lanes(half);
}
/// The viewing ray of a point of the picture [pixels].
PBF_INLINE Vec3Lanes ray_direction(const FrameTerms& frame, Lanes x, Lanes y) {
  if (!frame.perspective) return {0.0F, 0.0F, -1.0F};
  return {slope(x, frame.width, frame.half_width), slope(y, frame.height, frame.half_height),
          -1.0F};
}
PBF_INLINE Vec3Lanes ray_origin(const FrameTerms& frame, Lanes x, Lanes y) {
  if (frame.perspective) return {0.0F, 0.0F, 0.0F};
  return {slope(x, frame.width, frame.half_width), slope(y, frame.height, frame.half_height), 0.0F};
}
PBF_INLINE Vec3Lanes eye_position(const FrameTerms& frame, Lanes x, Lanes y, Lanes d) {
  const Lanes spread = frame.perspective ? d : Lanes(1);
  return {spread * slope(x, frame.width, frame.half_width),
          spread * slope(y, frame.height, frame.half_height), -d};
}

struct PixelLanes {
  Lanes x, y;
};
PBF_INLINE PixelLanes pixel_of(const FrameTerms& frame, const Vec3Lanes& p) {
  const Lanes scale = frame.perspective ? Lanes(-1) / p.z : Lanes(1);
  return {
      p.x * scale * Lanes(0.5F * frame.width / frame.half_width) + Lanes(0.5F * frame.width),
      p.y * scale * Lanes(0.5F * frame.height / frame.half_height) + Lanes(0.5F * frame.height)};
}
PBF_INLINE Lanes pixels_per_meter(const FrameTerms& frame, Lanes d) {
  return frame.perspective ? Lanes(frame.pixels_per_meter) / d : Lanes(frame.pixels_per_meter);
}
/// Parallel rays: as if the picture were seen from as far away as it is high.
PBF_INLINE float pixels_per_radian(const FrameTerms& frame) {
  return frame.perspective ? frame.pixels_per_meter : frame.height;
}
/// Length of a pixel's side at a depth [m].
PBF_INLINE Lanes pixel_at(const FrameTerms& frame, Lanes d) {
  const Lanes unit(1 / frame.pixels_per_meter);
  return frame.perspective ? unit * d : unit;
}

PBF_INLINE Vec3Lanes to_world(const FrameTerms& frame, const Vec3Lanes& v) {
  const float* m = frame.view;
  const auto along = [&](int k) PBF_LAMBDA_INLINE {
    return Lanes(m[k]) * v.x + Lanes(m[k + 1]) * v.y + Lanes(m[k + 2]) * v.z;
  };
  return {along(0), along(4), along(8)};
}
/// A point of the world in eye space.
PBF_INLINE Vec3Lanes eye_space(const FrameTerms& frame, const Vec3Lanes& p) {
  const float* m = frame.view;
  const auto row = [&](int k) PBF_LAMBDA_INLINE {
    return m[k] * p.x + m[4 + k] * p.y + m[8 + k] * p.z + m[12 + k];
  };
  return {row(0), row(1), row(2)};
}
/// A direction of the world in eye space.
PBF_INLINE Vec3Lanes to_eye(const FrameTerms& frame, const Vec3Lanes& v) {
  const float* m = frame.view;
  const auto along = [&](int k) PBF_LAMBDA_INLINE {
    return Lanes(m[k]) * v.x + Lanes(m[k + 4]) * v.y + Lanes(m[k + 8]) * v.z;
  };
  return {along(0), along(1), along(2)};
}

}  // namespace pbf::PBF_ISA_NAMESPACE
