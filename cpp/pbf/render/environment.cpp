#include "pbf/render/environment.hpp"

#include "pbf/render/camera.hpp"
#include "pbf/render/params.hpp"

#include <Eigen/Geometry>

namespace pbf {
namespace {

/// Tiles about a dozen sprites wide: in scale with the scene, whatever its size.
constexpr Real kTileInRadii = 12.5F;

using Light = Environment::Light;
using Tone = Environment::Tone;

Triple triple(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

Light light_of(Background background) {
  switch (background) {
    case Background::plain:
      return Light::plain;
    case Background::transparent:
      return Light::nothing;
    case Background::map:
      return Light::mapped;
    case Background::sky:
      break;
  }
  return Light::sky;
}

Light light_of(Reflection reflection) {
  switch (reflection) {
    case Reflection::plain:
      return Light::plain;
    case Reflection::map:
      return Light::mapped;
    case Reflection::sky:
      break;
  }
  return Light::sky_with_lights;
}

Tone tone_of(ToneMapping tone) {
  switch (tone) {
    case ToneMapping::none:
      return Tone::none;
    case ToneMapping::aces:
      return Tone::aces;
    case ToneMapping::soft:
      break;
  }
  return Tone::soft;
}

Real floor_height(const RenderParams& params, const Vec3& up) {
  if (params.floor_height) return *params.floor_height;
  if (!params.tank_lower) return 0;
  Real lowest = 0;  // of the tank's corners along up
  for (int k = 0; k < 3; ++k) {
    lowest += std::min(up[k] * (*params.tank_lower)[k], up[k] * (*params.tank_upper)[k]);
  }
  return lowest;
}

}  // namespace

Environment environment_of(const RenderParams& params, const Camera& camera) {
  const Vec3 up = params.up.normalized();
  const bool along_x = std::abs(up.x()) > 0.9F;
  const Vec3 floor_x = (along_x ? Vec3::UnitY() : Vec3::UnitX()).cross(up).cross(-up).normalized();
  return {.backdrop = light_of(params.background),
          .mirrored = light_of(params.reflection_in_force()),
          .tone = tone_of(params.tone_mapping),
          .exposure = params.exposure,
          .up = triple(up),
          .sun = triple(params.sun_direction.normalized()),
          .background_color = triple(params.background_color),
          .has_floor = params.floor,
          .floor_height = floor_height(params, up),
          .floor_x = triple(floor_x),
          .floor_y = triple(up.cross(floor_x)),
          .tile = kTileInRadii * params.radius,
          .has_tank = params.tank_lower.has_value(),
          .tank_lower = triple(params.tank_lower.value_or(Vec3::Zero())),
          .tank_upper = triple(params.tank_upper.value_or(Vec3::Zero())),
          .eye = triple(camera.eye),
          .shadow_strength = params.shadow};
}

}  // namespace pbf
