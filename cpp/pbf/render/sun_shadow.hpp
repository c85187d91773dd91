#pragma once

#include "pbf/render/mesh.hpp"
#include "pbf/render/params.hpp"

#include <cstdint>
#include <vector>

namespace pbf {

/// What the fluid leaves of the sun's light, as a picture taken along its rays:
///
///   T = exp(-absorption · t),   t = sum of V G over the particles [m],
///
/// V a particle's volume and G a Gaussian as wide as a sprite [1/m²], so that t is the length of
/// fluid that light comes through and the shadow's edge is as soft as the sprites are round.
/// Meshes let nothing through, with the same soft edge. Made by adding volumes to a grid: that
/// takes a tenth of the time of drawing sprites, and their shape would not outlive the softening.
struct SunShadow {
  static constexpr int kMostTexels = 512;  ///< to a side

  int width = 1, height = 1;
  /// A point p lies at u = x · (p - center) + 0.5, v = y · (p - center) + 0.5, both 0 to 1 where
  /// there is shadow.
  Vec3 center = Vec3::Zero(), x = Vec3::Zero(), y = Vec3::Zero();
  /// T in red, green and blue, 255 is all; one texel after the other, 255 along the border.
  std::vector<std::uint8_t> transmittance = {255, 255, 255, 255};
  [[nodiscard]] bool casts_none() const { return width == 1 && height == 1; }
};

/// The parameters of a shadow that is as deep as what is drawn is opaque.
/// @param tinted  fluid has its particles' colors
RenderParams shadow_params(RenderParams params, bool tinted);

/// One white texel where there is no shadow: without fluid and meshes, with the sun below the
/// floor, or with params.shadow = 0.
SunShadow sun_shadow(const PointsView& positions,
                     const RenderParams& params,
                     const Meshes& meshes = {});

}  // namespace pbf
