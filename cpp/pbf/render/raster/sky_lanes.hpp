#pragma once

#include "pbf/render/raster/frame_lanes.hpp"

// Of glsl/environment.glsl, where the formulas are explained, light as a function of a direction.
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

PBF_INLINE Vec3Lanes sky(const Scene& scene, const Vec3Lanes& direction) {
  const Environment& e = scene.environment;
  const Lanes elevation = dot(direction, lanes(e.up));
  const Vec3Lanes color =
      mix(horizon(), zenith(), Lanes(1) - exp(Lanes(-2.2F) * max(elevation, 0.0F)));
  const Lanes glow = max(dot(direction, lanes(e.sun)), 0.0F);
  const Lanes glow2 = glow * glow, glow4 = glow2 * glow2;
  return color + (Lanes(0.25F) * glow4 * glow4) * sunshine();
}

PBF_INLINE Vec3Lanes sky_with_lights(const Scene& scene, const Vec3Lanes& direction, Lanes spread) {
  const Environment& e = scene.environment;
  const Lanes wide = spread * Lanes(1 / pixels_per_radian(scene.frame));
  const Lanes variance = wide * wide * Lanes(1.0F / 12);  // of a pixel's square, along each side
  const auto lobe = [&](float k, Lanes off) PBF_LAMBDA_INLINE {
    const Lanes sharpness = Lanes(1) / (Lanes(1) + Lanes(k) * variance);
    return sharpness * exp(off * Lanes(-k) * sharpness);
  };
  const Lanes off = Lanes(1) - dot(direction, lanes(e.sun));
  const Lanes elevation = dot(direction, lanes(e.up));
  const Lanes band = smoothstep(0.02F, 0.45F, elevation) *
                     (Lanes(1) - Lanes(0.6F) * smoothstep(0.5F, 0.9F, elevation));
  const Lanes disc = Lanes(60) * lobe(700, off) + Lanes(5) * lobe(40, off);
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
      return {sky_with_lights(scene, direction, spread), 1.0F};
    case Environment::Light::sky:
      break;
  }
  return {sky(scene, direction), 1.0F};
}

}  // namespace pbf::PBF_ISA_NAMESPACE
