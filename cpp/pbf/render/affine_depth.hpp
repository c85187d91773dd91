#pragma once

namespace pbf {

// Affine depth (glsl/frame.glsl) where there is no surface.

/// There; less than any value of any layer. Shaders have its opposite where there is no far side,
/// for they look for the least of these.
inline constexpr float kNothing = -1e30F;
/// Less than that of any surface.
inline constexpr float kLeastSurface = -1e29F;

/// Depth [m], 0 where there is no surface.
inline float depth_or_none(float a, bool orthographic) {
  return a <= kLeastSurface ? 0 : orthographic ? -a : 1 / a;
}

}  // namespace pbf
