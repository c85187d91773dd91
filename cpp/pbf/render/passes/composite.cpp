#include "pbf/render/passes/composite.hpp"

#include "pbf/gl/draw.hpp"

#include <Eigen/Geometry>

#include <numbers>

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

/// Half the width of the tank's edges with the soft margin [pixels of the finished picture].
constexpr Real kEdgeHalfWidth = 1.3F;

/// Names of functions of display.glsl and environment.glsl.
std::vector<std::string> defines(const RenderParams& params) {
  const bool mirrors_sky = params.reflection_in_force() == Reflection::sky;
  const std::string backdrop = params.background == Background::sky     ? "sky"
                               : params.background == Background::plain ? "plain"
                                                                        : "nothing";
  return {"TONE tone_" + std::string(Choices<ToneMapping>::names.at(
                             static_cast<std::size_t>(params.tone_mapping))),
          "BACKDROP " + backdrop,
          "MIRRORED " + std::string(mirrors_sky ? "sky_with_lights" : "plain")};
}

/// Tiles about a dozen sprites wide: in scale with the scene, whatever its size.
constexpr Real kTileInRadii = 12.5F;

/// Texture units.
enum Unit { kDepth, kThickness, kNormal, kShadow, kTint };

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
}

}  // namespace

Composite::Composite(const GlslSource& source)
    : background_(
          source,
          {.vertex = {"fullscreen.vert"},
           .fragment = {"frame.glsl", "environment.glsl", "display.glsl", "background.frag"},
           .defines = {}}),
      fluid_(source,
             {.vertex = {"frame.glsl", "fluid_tiles.vert"},
              .fragment = {"frame.glsl", "environment.glsl", "display.glsl", "composite.frag"},
              .defines = {}}),
      spheres_(source,
               {.vertex = {"frame.glsl", "fluid_tiles.vert"},
                .fragment = {"frame.glsl", "environment.glsl", "display.glsl", "color.glsl",
                             "sphere_shading.frag"},
                .defines = {}}),
      tank_edges_(source,
                  {.vertex = {"frame.glsl", "tank_edges.vert"},
                   .fragment = {"frame.glsl", "tank_edges.frag"},
                   .defines = {}}) {
  // An error in a shader shows when the renderer is made.
  (void)background_.with(defines({}));
  (void)fluid_.with(defines({}));
  (void)spheres_.with(defines({}));
}

void Composite::operator()(const Surface& surface,
                           const Surroundings& surroundings,
                           const Camera& camera,
                           const RenderParams& params,
                           const Framebuffer& out) {
  const SunShadow& sun = surroundings.shadow;
  const Texture shadow(sun.width, sun.height, Format::rgba8, sun.transmittance.data(),
                       Sampling::linear);
  shadow.bind(kShadow);
  surface.depth.bind(kDepth);
  surface.thickness.bind(kThickness);
  surface.normal.bind(kNormal);
  if (surface.tint != nullptr) surface.tint->bind(kTint);
  out.bind();
  const Program& background = background_.with(defines(params));
  background.use();
  set_environment(background, surroundings, camera, params);
  no_vertices_.bind();
  draw_fullscreen();
  const Vec3 absorption = surface.tint != nullptr ? params.tint_absorption() : params.absorption;
  const bool opaque = params.style == Style::spheres;
  const Program& body = (opaque ? spheres_ : fluid_).with(defines(params));
  body.use();
  set_environment(body, surroundings, camera, params);
  body.set("u_depth", kDepth);
  body.set("u_thickness", kThickness);
  body.set("u_normal", kNormal);
  body.set("u_tint", kTint);
  body.set("u_has_tint", surface.tint != nullptr ? 1 : 0);
  body.set("u_absorption", absorption);
  body.set("u_scatter", params.scatter);
  body.set("u_refractive_index", params.refractive_index);
  body.set("u_radius", opaque ? params.sphere_radius_in_force() : params.radius);
  const Real disc = std::numbers::pi_v<Real> * params.radius * params.radius;
  body.set("u_sprite_thickness", params.volume_in_force() / disc);
  surface.tiles.draw(Blend::over);
  if (!params.tank_lower) return;
  tank_edges_.use();
  tank_edges_.set("u_depth", kDepth);
  tank_edges_.set("u_thickness", kThickness);
  tank_edges_.set("u_opaque", opaque ? 1 : 0);
  tank_edges_.set("u_absorption", absorption);
  tank_edges_.set("u_tank_lower", *params.tank_lower);
  tank_edges_.set("u_tank_upper", *params.tank_upper);
  tank_edges_.set("u_half_width", kEdgeHalfWidth * static_cast<Real>(params.supersampling));
  no_vertices_.bind();
  set_draw_state(Blend::over);
  glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, 12);
}

}  // namespace pbf
