#pragma once

namespace pbf {

struct Camera;
struct RenderParams;

/// Three numbers, for loops that are compiled for several instruction sets.
struct Triple {
  float x, y, z;
};

/// What stands behind and around the fluid, and how its light comes to a screen: the uniforms of
/// glsl/environment.glsl and display.glsl, where they are explained, for shaders and for C++.
struct Environment {
  /// Functions of a direction in environment.glsl.
  enum class Light { nothing, plain, sky, sky_with_lights, mapped };
  /// tone_soft and so on in display.glsl.
  enum class Tone { soft, none, aces };

  Light backdrop, mirrored;
  Tone tone;
  float exposure;
  Triple up, sun;  ///< unit vectors
  Triple background_color;
  bool has_floor;
  float floor_height;       ///< along up [m]
  Triple floor_x, floor_y;  ///< unit vectors along the floor
  float tile;               ///< side of a floor tile [m]
  bool has_tank;
  Triple tank_lower, tank_upper;  ///< [m]
  Triple eye;                     ///< [m]
  float shadow_strength;          ///< share of the sun in the floor's light
};

Environment environment_of(const RenderParams& params, const Camera& camera);

}  // namespace pbf
