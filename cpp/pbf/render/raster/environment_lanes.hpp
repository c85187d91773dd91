#pragma once

#include "pbf/render/raster/frame_lanes.hpp"

// glsl/environment.glsl, where the formulas are explained.
namespace pbf::PBF_ISA_NAMESPACE {

using raster::Scene;

/// Light, multiplied by alpha, and alpha.
struct RgbaLanes {
  Vec3Lanes rgb;
  Lanes a;
};
PBF_INLINE RgbaLanes mix(const RgbaLanes& a, const RgbaLanes& b, Lanes share) {
  return {mix(a.rgb, b.rgb, share), mix(a.a, b.a, share)};
}
PBF_INLINE RgbaLanes select(Mask mask, const RgbaLanes& a, const RgbaLanes& b) {
  return {select(mask, a.rgb, b.rgb), select(mask, a.a, b.a)};
}

PBF_INLINE Vec3Lanes horizon() { return {0.66F, 0.73F, 0.79F}; }
PBF_INLINE Vec3Lanes zenith() { return {0.08F, 0.20F, 0.42F}; }
PBF_INLINE Vec3Lanes sunshine() { return {1.0F, 0.93F, 0.80F}; }
inline constexpr float kFloor = 0.5F;

PBF_INLINE Vec3Lanes sky(const Scene& scene, const Vec3Lanes& direction) {
  const Environment& e = scene.environment;
  const Lanes elevation = dot(direction, lanes(e.up));
  const Vec3Lanes color =
      mix(horizon(), zenith(), Lanes(1) - exp(Lanes(-2.2F) * max(elevation, 0.0F)));
  const Lanes glow = max(dot(direction, lanes(e.sun)), 0.0F);
  const Lanes glow2 = glow * glow, glow4 = glow2 * glow2;
  return color + (Lanes(0.25F) * glow4 * glow4) * sunshine();
}

PBF_INLINE Vec3Lanes sky_with_lights(const Scene& scene, const Vec3Lanes& direction) {
  const Environment& e = scene.environment;
  const Lanes off = Lanes(1) - dot(direction, lanes(e.sun));
  const Lanes elevation = dot(direction, lanes(e.up));
  const Lanes band = smoothstep(0.02F, 0.45F, elevation) *
                     (Lanes(1) - Lanes(0.6F) * smoothstep(0.5F, 0.9F, elevation));
  const Lanes disc = Lanes(60) * exp(off * Lanes(-700)) + Lanes(5) * exp(off * Lanes(-40));
  return sky(scene, direction) + disc * sunshine() +
         (Lanes(1.6F) * band) * Vec3Lanes{1.1F, 1.25F, 1.4F};
}

/// A point between four texels, for one lane.
PBF_INLINE Four panorama_texel(const raster::PanoramaTexels::Level& level, float u, float v) {
  const float x = u * static_cast<float>(level.width) - 0.5F;
  const float y = v * static_cast<float>(level.height) - 0.5F;
  const float left = __builtin_floorf(x), below = __builtin_floorf(y);
  const auto column = [&](float at) PBF_LAMBDA_INLINE {
    const int k = static_cast<int>(at) % level.width;  // once around
    return k < 0 ? k + level.width : k;
  };
  const auto row = [&](float at) PBF_LAMBDA_INLINE {
    const int k = static_cast<int>(at);
    return k < 0 ? 0 : k < level.height ? k : level.height - 1;
  };
  const auto texel = [&](int c, int r) PBF_LAMBDA_INLINE {
    return load<Four>(level.first + 4 * (static_cast<std::ptrdiff_t>(r) * level.width + c));
  };
  const int c0 = column(left), c1 = column(left + 1), r0 = row(below), r1 = row(below + 1);
  const float right = x - left, up = y - below;
  const Four low = texel(c0, r0) + right * (texel(c1, r0) - texel(c0, r0));
  const Four high = texel(c0, r1) + right * (texel(c1, r1) - texel(c0, r1));
  return low + up * (high - low);
}

PBF_INLINE Vec3Lanes mapped(const Scene& scene, const Vec3Lanes& direction, Lanes spread) {
  const Environment& e = scene.environment;
  const Lanes ahead = dot(direction, lanes(e.floor_y)), right = dot(direction, lanes(e.floor_x));
  const Lanes around = atan(right, ahead) * Lanes(1 / 6.2831853F) + Lanes(0.5F);
  const Lanes height = clamp(dot(direction, lanes(e.up)), -1.0F, 1.0F);
  const Lanes above = Lanes(1) - acos(height) * Lanes(1 / 3.1415927F);
  const float texels_of_pixel =
      static_cast<float>(scene.map.levels[0].width) / (6.2831853F * pixels_per_radian(scene.frame));
  const Lanes texels = max(spread * Lanes(texels_of_pixel), 1.0F);
  const float deepest = static_cast<float>(scene.map.count - 1);
  const Lanes level = min(log(texels) * Lanes(1 / 0.693147181F), deepest);
  const Ints fine = clamp(to_ints(level), 0, scene.map.count - 1);
  const Ints coarse = clamp(fine + 1, 0, scene.map.count - 1);
  const Lanes share = level - to_lanes(fine);
  Vec3Lanes light;
  for (int lane = 0; lane < kLanes; ++lane) {
    const auto texel_of = [&](int of) PBF_LAMBDA_INLINE {
      return panorama_texel(scene.map.levels[of], around.v[lane], above.v[lane]);
    };
    Four texel = texel_of(fine[lane]);
    if (share.v[lane] > 0) texel += share.v[lane] * (texel_of(coarse[lane]) - texel);
    light.x.v[lane] = texel[0];
    light.y.v[lane] = texel[1];
    light.z.v[lane] = texel[2];
  }
  return light;
}

/// What is seen behind the fluid, or in its surface, by the name of the shader's function.
/// @param spread  of the rays about the direction [pixels]
PBF_INLINE RgbaLanes light_from(const Scene& scene,
                                Environment::Light light,
                                const Vec3Lanes& direction,
                                Lanes spread) {
  switch (light) {
    case Environment::Light::nothing:
      return {{0.0F, 0.0F, 0.0F}, 0.0F};
    case Environment::Light::plain:
      return {lanes(scene.environment.background_color), 1.0F};
    case Environment::Light::mapped:
      return {mapped(scene, direction, spread), 1.0F};
    case Environment::Light::sky_with_lights:
      return {sky_with_lights(scene, direction), 1.0F};
    case Environment::Light::sky:
      break;
  }
  return {sky(scene, direction), 1.0F};
}

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
