#pragma once

#include "pbf/gl/program.hpp"
#include "pbf/gl/texture.hpp"
#include "pbf/render/camera.hpp"
#include "pbf/render/mesh.hpp"
#include "pbf/render/params.hpp"
#include "pbf/render/sun_shadow.hpp"

namespace pbf {

/// What stands around the fluid.
struct Surroundings {
  const SunShadow& shadow;
  const Meshes* meshes = nullptr;
  const Texture* map = nullptr;  ///< light from all directions (environment_map.hpp), with mipmaps
};

/// Texture units of the passes that make the picture.
enum Unit {
  kDepth,
  kThickness,
  kNormal,
  kShadow,
  kMap,
  kMeshLight,
  kMeshDepth,
  kSpheres,
  kTint,
  kBack
};

/// The functions that stand for what is asked for, by their names in glsl/environment.glsl and
/// display.glsl.
std::vector<std::string> environment_defines(const RenderParams& params, bool with_shadow);

/// Pixels, row 0 below: x0 <= x < x1, y0 <= y < y1.
struct Rectangle {
  int x0, y0, x1, y1;
};

/// Where on the floor the shadow can be seen.
Rectangle shadow_rectangle(const SunShadow& shadow,
                           const Camera& camera,
                           const RenderParams& params,
                           int width,
                           int height);

/// Sets the uniforms of these two files. The program must be in use, and the shadow bound.
void set_environment(const Program& program,
                     const Surroundings& surroundings,
                     const Camera& camera,
                     const RenderParams& params);

}  // namespace pbf
