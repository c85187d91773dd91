#pragma once

#include "pbf/render/raster/environment_lanes.hpp"
#include "pbf/render/raster/picture.hpp"

// glsl/display.glsl, and what a target does with the light: encoding and blending.
namespace pbf::PBF_ISA_NAMESPACE {

using raster::Picture;

PBF_INLINE Lanes tone(Environment::Tone curve, Lanes c) {
  switch (curve) {
    case Environment::Tone::none:
      return min(c, 1.0F);
    case Environment::Tone::aces: {
      const Lanes above = c * (Lanes(2.51F) * c + Lanes(0.03F));
      const Lanes below = c * (Lanes(2.43F) * c + Lanes(0.59F)) + Lanes(0.14F);
      return clamp(above / below, 0.0F, 1.0F);
    }
    case Environment::Tone::soft:
      break;
  }
  const Lanes over = max(c - Lanes(0.8F), 0.0F);
  return min(c, 0.8F) + Lanes(0.2F) * over / (over + Lanes(0.2F));
}

PBF_INLINE RgbaLanes display(const Environment& e, const Vec3Lanes& light, Lanes alpha) {
  const auto shown = [&](Lanes c) PBF_LAMBDA_INLINE {
    return tone(e.tone, max(c * Lanes(e.exposure), 0.0F));
  };
  const Vec3Lanes color{shown(light.x), shown(light.y), shown(light.z)};
  return {color, max(alpha, max(color.x, max(color.y, color.z)))};
}

/// 0 to 255, of light from 0 to 1.
PBF_INLINE Ints encoded_srgb(Lanes c) {
  c = clamp(c, 0.0F, 1.0F);
  const Lanes curved = Lanes(1.055F) * pow(max(c, 0.001F), 1 / 2.4F) - Lanes(0.055F);
  return to_ints(select(c > Lanes(0.0031308F), curved, Lanes(12.92F) * c) * Lanes(255) +
                 Lanes(0.5F));
}

PBF_INLINE Ints packed(const RgbaLanes& c) {
  const Ints alpha = to_ints(clamp(c.a, 0.0F, 1.0F) * Lanes(255) + Lanes(0.5F));
  return encoded_srgb(c.rgb.x) | encoded_srgb(c.rgb.y) << 8 | encoded_srgb(c.rgb.z) << 16 |
         alpha << 24;
}
PBF_INLINE RgbaLanes unpacked(const Picture& picture, Ints pixel) {
  const auto light = [&](int shift)
                         PBF_LAMBDA_INLINE { return fetch(picture.light, (pixel >> shift) & 255); };
  return {{light(0), light(8), light(16)}, to_lanes((pixel >> 24) & 255) * Lanes(1.0F / 255)};
}

/// A vector of pixels [x, x + kLanes) of a row, as far as the picture reaches.
PBF_INLINE Ints load_pixels(const Picture& picture, int x, int y) {
  if (x + kLanes <= picture.width) return load<Ints>(picture.row(y) + x);
  Ints pixels{};
  std::memcpy(&pixels, picture.row(y) + x, sizeof(std::uint32_t) * (picture.width - x));
  return pixels;
}
PBF_INLINE void store_pixels(const Picture& picture, int x, int y, Ints pixels) {
  const int count = x + kLanes <= picture.width ? kLanes : picture.width - x;
  std::memcpy(picture.row(y) + x, &pixels, sizeof(std::uint32_t) * count);
}

/// Light over what is there; where the mask does not hold, that stays as it is.
PBF_INLINE void blend_over(
    const Picture& picture, int x, int y, const RgbaLanes& light, Mask where) {
  const Ints before = load_pixels(picture, x, y);
  RgbaLanes sum = light;
  if (any((light.a < Lanes(1)) & where)) {
    const RgbaLanes under = unpacked(picture, before);
    const Lanes left = max(Lanes(1) - light.a, 0.0F);
    sum = {light.rgb + left * under.rgb, light.a + left * under.a};
  }
  store_pixels(picture, x, y, where.v ? packed(sum) : before);
}

}  // namespace pbf::PBF_ISA_NAMESPACE
