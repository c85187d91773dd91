#include "pbf/render/passes/environment.hpp"

#include <Eigen/Geometry>

namespace pbf {
namespace {

Real floor_height(const RenderParams& params, const Vec3& up) {
  if (params.floor_height) return *params.floor_height;
  if (!params.tank_lower) return 0;
  Real lowest = 0;  // of the tank's corners along up
  for (int k = 0; k < 3; ++k) {
    lowest += std::min(up[k] * (*params.tank_lower)[k], up[k] * (*params.tank_upper)[k]);
  }
  return lowest;
}

/// Tiles about a dozen sprites wide: in scale with the scene, whatever its size.
constexpr Real kTileInRadii = 12.5F;

const char* name_of(Background background) {
  switch (background) {
    case Background::plain:
      return "plain";
    case Background::transparent:
      return "nothing";
    case Background::map:
      return "mapped";
    case Background::sky:
      break;
  }
  return "sky";
}

const char* name_of(Reflection reflection) {
  switch (reflection) {
    case Reflection::plain:
      return "plain";
    case Reflection::map:
      return "mapped";
    case Reflection::sky:
      break;
  }
  return "sky_with_lights";
}

}  // namespace

std::vector<std::string> environment_defines(const RenderParams& params, bool with_shadow) {
  std::vector<std::string> defines{
      "TONE tone_" + std::string(Choices<ToneMapping>::names.at(
                         static_cast<std::size_t>(params.tone_mapping))),
      "BACKDROP " + std::string(name_of(params.background)),
      "MIRRORED " + std::string(name_of(params.reflection_in_force()))};
  if (params.shows_map()) defines.emplace_back("MAP");
  if (with_shadow) defines.emplace_back("SHADOW");
  return defines;
}

Rectangle shadow_rectangle(const SunShadow& shadow,
                           const Camera& camera,
                           const RenderParams& params,
                           int width,
                           int height) {
  if (shadow.casts_none()) return {0, 0, 0, 0};
  const Vec3 up = params.up.normalized();
  const Vec3 sun = params.sun_direction.normalized();
  const Eigen::Matrix4f view = camera.view();
  const Vec3 across_x = shadow.x / shadow.x.squaredNorm();
  const Vec3 across_y = shadow.y / shadow.y.squaredNorm();
  Eigen::Array2f low(1, 1), high(-1, -1);  // of the picture, -1 to 1
  for (int k = 0; k < 4; ++k) {
    const Real u = (k & 1) == 0 ? -0.5F : 0.5F;
    const Real v = (k & 2) == 0 ? -0.5F : 0.5F;
    const Vec3 corner = shadow.center + u * across_x + v * across_y;
    const Vec3 on_floor = corner - (up.dot(corner) - floor_height(params, up)) / up.dot(sun) * sun;
    const Vec3 p = view.topLeftCorner<3, 3>() * on_floor + view.topRightCorner<3, 1>();
    const float depth = camera.orthographic ? 1 : -p.z();
    const Eigen::Array2f at =
        p.head<2>().array() / (depth * camera.half_height()) *
        Eigen::Array2f(static_cast<float>(height) / static_cast<float>(width), 1);
    // Behind the eye, or too far away to be a number: it may be anywhere.
    if (-p.z() < camera.near || !at.isFinite().all()) return {0, 0, width, height};
    low = low.min(at);
    high = high.max(at);
  }
  low = 0.5F * low.max(-1).min(1) + 0.5F;
  high = 0.5F * high.max(-1).min(1) + 0.5F;
  const auto w = static_cast<float>(width);
  const auto h = static_cast<float>(height);
  return {static_cast<int>(low.x() * w), static_cast<int>(low.y() * h),
          static_cast<int>(std::ceil(high.x() * w)), static_cast<int>(std::ceil(high.y() * h))};
}

void set_environment(const Program& program,
                     const Surroundings& surroundings,
                     const Camera& camera,
                     const RenderParams& params) {
  const Vec3 up = params.up.normalized();
  const bool along_x = std::abs(up.x()) > 0.9F;
  const Vec3 floor_x = (along_x ? Vec3::UnitY() : Vec3::UnitX()).cross(up).cross(-up).normalized();
  program.set("u_up", up);
  program.set("u_sun", Vec3(params.sun_direction.normalized()));
  program.set("u_background_color", params.background_color);
  program.set("u_has_floor", params.floor ? 1 : 0);
  program.set("u_floor_height", floor_height(params, up));
  program.set("u_tile", kTileInRadii * params.radius);
  program.set("u_has_tank", params.tank_lower ? 1 : 0);
  program.set("u_tank_lower", params.tank_lower.value_or(Vec3::Zero()));
  program.set("u_tank_upper", params.tank_upper.value_or(Vec3::Zero()));
  program.set("u_floor_x", floor_x);
  program.set("u_floor_y", Vec3(up.cross(floor_x)));
  program.set("u_eye", camera.eye);
  program.set("u_shadow", kShadow);
  program.set("u_shadow_center", surroundings.shadow.center);
  program.set("u_shadow_x", surroundings.shadow.x);
  program.set("u_shadow_y", surroundings.shadow.y);
  program.set("u_shadow_strength", params.shadow);
  program.set("u_exposure", params.exposure);
  program.set("u_map", kMap);
  const int map_width = surroundings.map == nullptr ? 1 : surroundings.map->width();
  program.set("u_map_width", static_cast<Real>(map_width));
}

}  // namespace pbf
