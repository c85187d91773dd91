#pragma once

#include "pbf/gl/program.hpp"
#include "pbf/gl/texture.hpp"
#include "pbf/render/camera.hpp"
#include "pbf/render/environment.hpp"
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
inline constexpr int kDepth = 0, kThickness = 1, kNormal = 2, kShadow = 3, kMap = 4, kMeshLight = 5,
                     kMeshDepth = 6, kSpheres = 7, kTint = 8, kBack = 9;

/// The functions that stand for what is asked for, by their names in glsl/environment.glsl and
/// display.glsl.
std::vector<std::string> environment_defines(const Environment& environment, bool with_shadow);

/// Sets the uniforms of these two files. The program must be in use, and the shadow bound.
void set_environment(const Program& program,
                     const Surroundings& surroundings,
                     const Environment& environment);

}  // namespace pbf
