#include "pbf/render/passes/composite.hpp"

#include "pbf/gl/draw.hpp"

#include <numbers>

namespace pbf {
namespace {

/// Half the width of the tank's edges with the soft margin [pixels of the finished picture].
constexpr Real kEdgeHalfWidth = 1.3F;

std::vector<std::string> with_meshes(std::vector<std::string> defines, const MeshTargets* meshes) {
  if (meshes != nullptr) defines.emplace_back("MESHES");
  return defines;
}

}  // namespace

Composite::Composite(const GlslSource& source)
    : backdrop_(source),
      fluid_(source,
             {.vertex = {"frame.glsl", "fluid_tiles.vert"},
              .fragment = {"frame.glsl", "environment.glsl", "display.glsl", "tank.glsl",
                           "refraction.glsl", "meshes.glsl", "composite.frag"},
              .defines = {}}),
      spheres_(source,
               {.vertex = {"frame.glsl", "fluid_tiles.vert"},
                .fragment = {"frame.glsl", "environment.glsl", "display.glsl", "color.glsl",
                             "sphere_shading.frag"},
                .defines = {}}),
      tank_edges_(source,
                  {.vertex = {"frame.glsl", "tank_edges.vert"},
                   .fragment = {"frame.glsl", "tank_edges.frag"},
                   .defines = {}}),
      opaque_meshes_(source) {
  // An error in a shader shows when the renderer is made.
  const auto defines = environment_defines(environment_of({}, {}), true);
  (void)fluid_.with(defines);
  (void)spheres_.with(defines);
  (void)tank_edges_.with({});
}

void Composite::operator()(const Surface& surface,
                           const Surroundings& surroundings,
                           const Camera& camera,
                           const RenderParams& params,
                           const Framebuffer& out,
                           const MeshTargets* meshes) {
  const SunShadow& sun = surroundings.shadow;
  const Texture shadow(sun.width, sun.height, Format::rgba8, sun.transmittance.data(),
                       Sampling::linear);
  shadow.bind(kShadow);
  if (surroundings.map != nullptr) surroundings.map->bind(kMap);
  surface.depth.bind(kDepth);
  surface.thickness.bind(kThickness);
  surface.back.bind(kBack);
  surface.normal.bind(kNormal);
  surface.spheres.bind(kSpheres);
  if (surface.tint != nullptr) surface.tint->bind(kTint);
  backdrop_(surroundings, camera, params, out);
  if (meshes != nullptr) {
    opaque_meshes_(*surroundings.meshes, surroundings, camera, params, *meshes);
    meshes->light.bind(kMeshLight);
    meshes->depth.bind(kMeshDepth);
  }
  out.bind();
  const Vec3 absorption = surface.tint != nullptr ? params.tint_absorption() : params.absorption;
  const Environment environment = environment_of(params, camera);
  const bool opaque = params.style == Style::spheres;
  const Program& body =
      (opaque ? spheres_ : fluid_)
          .with(with_meshes(environment_defines(environment, !sun.casts_none()), meshes));
  body.use();
  set_environment(body, surroundings, environment);
  body.set("u_depth", kDepth);
  body.set("u_thickness", kThickness);
  body.set("u_back", kBack);
  body.set("u_normal", kNormal);
  body.set("u_spheres", kSpheres);
  body.set("u_drop_radius", params.drop_radius_in_force());
  body.set("u_mesh_light", kMeshLight);
  body.set("u_mesh_depth", kMeshDepth);
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
  const Program& tank_edges = tank_edges_.with(with_meshes({}, meshes));
  tank_edges.use();
  tank_edges.set("u_depth", kDepth);
  tank_edges.set("u_thickness", kThickness);
  tank_edges.set("u_opaque", opaque ? 1 : 0);
  tank_edges.set("u_mesh_depth", kMeshDepth);
  tank_edges.set("u_absorption", absorption);
  tank_edges.set("u_tank_lower", *params.tank_lower);
  tank_edges.set("u_tank_upper", *params.tank_upper);
  tank_edges.set("u_half_width", kEdgeHalfWidth * static_cast<Real>(params.supersampling));
  no_vertices_.bind();
  set_draw_state(Blend::over);
  glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, 12);
}

}  // namespace pbf
