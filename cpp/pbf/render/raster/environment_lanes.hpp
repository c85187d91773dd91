#pragma once

#include "pbf/render/raster/sky_lanes.hpp"

// Of glsl/environment.glsl, where the formulas are explained, the floor, and what a ray meets.
namespace pbf::PBF_ISA_NAMESPACE {

inline constexpr float kFloor = 0.5F;

PBF_INLINE Lanes line_cover(Lanes x, float w, Lanes f) {
  const Lanes off = abs(x - floor(x + Lanes(0.5F)));
  const Lanes cover =
      clamp(min(Lanes(w) + f - off, Lanes(2) * min(Lanes(w), f)), 0.0F, 1.0F) / (Lanes(2) * f);
  return mix(cover, Lanes(2 * w), smoothstep(0.1F, 0.5F, f));
}

PBF_INLINE Lanes contact_shadow(const Environment& e, Lanes px, Lanes py) {
  const Vec3Lanes low = lanes(e.tank_lower), high = lanes(e.tank_upper);
  const Vec3Lanes middle = Lanes(0.5F) * (low + high), half_size = Lanes(0.5F) * (high - low);
  const Vec3Lanes x = lanes(e.floor_x), y = lanes(e.floor_y);
  const Lanes hx = dot(half_size, abs(x)), hy = dot(half_size, abs(y));
  const Lanes reach = Lanes(0.35F) * min(hx, hy) + Lanes(0.05F) * max(hx, hy);
  const Lanes beside_x = max(abs(px - dot(middle, x)) - hx, 0.0F);
  const Lanes beside_y = max(abs(py - dot(middle, y)) - hy, 0.0F);
  const Lanes away = sqrt(beside_x * beside_x + beside_y * beside_y);
  const Lanes fade = Lanes(1) - clamp(away / reach, 0.0F, 1.0F);
  return Lanes(1) - Lanes(0.38F) * fade * fade;
}

PBF_INLINE Vec3Lanes sunlight(const Scene& scene, const Vec3Lanes& point) {
  const raster::ShadowTexels& shadow = scene.shadow;
  if (shadow.first == nullptr) return {1.0F, 1.0F, 1.0F};
  const Vec3Lanes p = point - lanes(shadow.center);
  const auto width = static_cast<float>(shadow.width), height = static_cast<float>(shadow.height);
  const Lanes u = (dot(lanes(shadow.x), p) + Lanes(0.5F)) * Lanes(width) - Lanes(0.5F);
  const Lanes v = (dot(lanes(shadow.y), p) + Lanes(0.5F)) * Lanes(height) - Lanes(0.5F);
  // Along the border all light comes through, as beyond it.
  const Mask inside =
      (u > Lanes(0.0F)) & (u < Lanes(width - 1)) & (v > Lanes(0.0F)) & (v < Lanes(height - 1));
  if (!any(inside)) return {1.0F, 1.0F, 1.0F};
  const Ints column = clamp(to_ints(select(inside, u, 0.0F)), 0, shadow.width - 2);
  const Ints row = clamp(to_ints(select(inside, v, 0.0F)), 0, shadow.height - 2);
  const Lanes right = u - to_lanes(column), up = v - to_lanes(row);
  const Ints at = row * shadow.width + column;
  const auto texel = [&](int offset) PBF_LAMBDA_INLINE {
    Ints result;
    for (int lane = 0; lane < kLanes; ++lane) {
      result[lane] = load<std::int32_t>(shadow.first + 4 * (at[lane] + offset));
    }
    return result;
  };
  const Ints t00 = texel(0), t10 = texel(1), t01 = texel(shadow.width);
  const Ints t11 = texel(shadow.width + 1);
  const auto channel = [&](int shift) PBF_LAMBDA_INLINE {
    const auto of = [&](Ints t) PBF_LAMBDA_INLINE { return to_lanes((t >> shift) & 255); };
    const Lanes left = mix(mix(of(t00), of(t10), right), mix(of(t01), of(t11), right), up);
    const Lanes dark =
        Lanes(scene.environment.shadow_strength) * (Lanes(1) - left * Lanes(1.0F / 255));
    return select(inside, Lanes(1) - dark, 1.0F);
  };
  return {channel(0), channel(8), channel(16)};
}

PBF_INLINE Vec3Lanes floor_color(const Scene& scene,
                                 const Vec3Lanes& point,
                                 Lanes reach_x,
                                 Lanes reach_y) {
  const Environment& e = scene.environment;
  const Lanes x = dot(point, lanes(e.floor_x)), y = dot(point, lanes(e.floor_y));
  const Lanes per_tile(1 / e.tile);
  const Lanes lines = max(line_cover(x * per_tile, 0.010F, max(reach_x * per_tile, 1e-3F)),
                          line_cover(y * per_tile, 0.010F, max(reach_y * per_tile, 1e-3F)));
  Lanes gray = Lanes(kFloor) * (Lanes(1) - Lanes(0.35F) * lines);
  if (e.has_tank) gray *= contact_shadow(e, x, y);
  return gray * sunlight(scene, point);
}

PBF_INLINE Lanes height_above_floor(const Environment& e, const Vec3Lanes& point) {
  return dot(point, lanes(e.up)) - Lanes(e.floor_height);
}
PBF_INLINE float eye_height(const Environment& e) {
  return e.eye.x * e.up.x + e.eye.y * e.up.y + e.eye.z * e.up.z - e.floor_height;
}
PBF_INLINE Mask is_below_floor(const Environment& e, const Vec3Lanes& point) {
  const bool can_be = e.has_floor && eye_height(e) > 0;
  return (can_be ? height_above_floor(e, point) : Lanes(0.0F)) < Lanes(0.0F);
}
PBF_INLINE Lanes distance_to_floor(const Environment& e,
                                   const Vec3Lanes& point,
                                   const Vec3Lanes& direction) {
  if (!e.has_floor) return kNowhere;
  const Lanes down = -dot(direction, lanes(e.up));
  const Lanes way = max(height_above_floor(e, point), 0.0F) / max(down, 1e-4F);
  return select(down > Lanes(1e-4F), way, kNowhere);
}

/// @param beyond  what is farther than the floor (light_from)
/// @param wanted  pixels that count
PBF_INLINE RgbaLanes environment(const Scene& scene,
                                 Environment::Light beyond,
                                 const Vec3Lanes& point,
                                 const Vec3Lanes& direction,
                                 Lanes travelled,
                                 Lanes spread,
                                 Mask wanted) {
  const Environment& e = scene.environment;
  const Lanes way = distance_to_floor(e, point, direction);
  const Mask meets = is_met(way);
  if (eye_height(e) < 0 || !any(meets & wanted)) {
    return light_from(scene, beyond, direction, spread);
  }
  const Lanes down = -dot(direction, lanes(e.up));
  const Lanes wide = Lanes(0.7F) * spread * pixel_at(scene.frame, travelled + way);
  Lanes along_x = abs(dot(direction, lanes(e.floor_x)));
  Lanes along_y = abs(dot(direction, lanes(e.floor_y)));
  const Lanes scale = Lanes(1) / max(sqrt(along_x * along_x + along_y * along_y), 1e-6F);
  along_x *= scale;
  along_y *= scale;
  const Lanes stretch = Lanes(1) / max(down, 0.01F);
  const Vec3Lanes color =
      floor_color(scene, point + select(meets, way, 0.0F) * direction,
                  wide * (along_x * stretch + along_y), wide * (along_y * stretch + along_x));
  const Lanes far = Lanes(1) - exp((travelled + way) * Lanes(-1 / (30 * e.tile)));
  const Lanes share = select(meets, far * smoothstep(-0.45F, 0.0F, -down), 1.0F);
  const RgbaLanes floor{color, 1.0F};
  if (!any((share > Lanes(0.0F)) & wanted)) return floor;
  return mix(floor, light_from(scene, beyond, direction, spread), share);
}

}  // namespace pbf::PBF_ISA_NAMESPACE
