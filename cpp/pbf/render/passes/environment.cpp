#include "pbf/render/passes/environment.hpp"

namespace pbf {
namespace {

const char* name_of(Environment::Light light) {
  using Light = Environment::Light;
  switch (light) {
    case Light::nothing:
      return "nothing";
    case Light::plain:
      return "plain";
    case Light::mapped:
      return "mapped";
    case Light::sky_with_lights:
      return "sky_with_lights";
    case Light::sky:
      break;
  }
  return "sky";
}

const char* name_of(Environment::Tone tone) {
  using Tone = Environment::Tone;
  return tone == Tone::none ? "tone_none" : tone == Tone::aces ? "tone_aces" : "tone_soft";
}

Vec3 vec3(const Triple& t) { return {t.x, t.y, t.z}; }

}  // namespace

std::vector<std::string> environment_defines(const Environment& environment, bool with_shadow) {
  using Light = Environment::Light;
  std::vector<std::string> defines{"TONE " + std::string(name_of(environment.tone)),
                                   "BACKDROP " + std::string(name_of(environment.backdrop)),
                                   "MIRRORED " + std::string(name_of(environment.mirrored))};
  if (environment.backdrop == Light::mapped || environment.mirrored == Light::mapped) {
    defines.emplace_back("MAP");
  }
  if (with_shadow) defines.emplace_back("SHADOW");
  return defines;
}

void set_environment(const Program& program,
                     const Surroundings& surroundings,
                     const Environment& environment) {
  program.set("u_up", vec3(environment.up));
  program.set("u_sun", vec3(environment.sun));
  program.set("u_background_color", vec3(environment.background_color));
  program.set("u_has_floor", environment.has_floor ? 1 : 0);
  program.set("u_floor_height", environment.floor_height);
  program.set("u_tile", environment.tile);
  program.set("u_has_tank", environment.has_tank ? 1 : 0);
  program.set("u_tank_lower", vec3(environment.tank_lower));
  program.set("u_tank_upper", vec3(environment.tank_upper));
  program.set("u_floor_x", vec3(environment.floor_x));
  program.set("u_floor_y", vec3(environment.floor_y));
  program.set("u_eye", vec3(environment.eye));
  program.set("u_shadow", kShadow);
  program.set("u_shadow_center", surroundings.shadow.center);
  program.set("u_shadow_x", surroundings.shadow.x);
  program.set("u_shadow_y", surroundings.shadow.y);
  program.set("u_shadow_strength", environment.shadow_strength);
  program.set("u_exposure", environment.exposure);
  program.set("u_map", kMap);
  const int map_width = surroundings.map == nullptr ? 1 : surroundings.map->width();
  program.set("u_map_width", static_cast<Real>(map_width));
}

}  // namespace pbf
