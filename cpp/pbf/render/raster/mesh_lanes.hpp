#pragma once

#include "pbf/render/raster/composite_kernels.hpp"
#include "pbf/render/raster/environment_lanes.hpp"

// Of glsl/composite.frag what rays in the fluid see of meshes.
namespace pbf::PBF_ISA_NAMESPACE {

using raster::MeshTexels;

/// How far points of rays from p lie behind the mesh that the picture shows there [m], and its
/// light.
struct BehindMesh {
  Lanes way;
  Vec3Lanes light;
};
PBF_INLINE BehindMesh behind_mesh(const Scene& scene,
                                  const MeshTexels& meshes,
                                  const Vec3Lanes& p,
                                  const Vec3Lanes& point) {
  const FrameTerms& frame = scene.frame;
  const PixelLanes at = pixel_of(frame, point);
  const Ints x = to_ints(clamp(at.x, 0.0F, frame.width - 1));
  const Ints y = to_ints(clamp(at.y, 0.0F, frame.height - 1));
  const Lanes a = fetch(meshes.depth, x, y), depth = depth_of(frame, a);
  return {select(is_surface(a) & (depth > -p.z), -point.z - depth, -kNowhere),
          fetch(meshes.light, x, y)};
}

/// Where rays from points in eye space meet a mesh, as far as the picture knows.
struct MeshHit {
  Mask meets;
  Lanes way;
  Vec3Lanes light;
};
PBF_INLINE MeshHit meet_mesh(const Scene& scene,
                             const MeshTexels& meshes,
                             const Vec3Lanes& p,
                             const Vec3Lanes& direction,
                             Lanes farthest,
                             Mask wanted) {
  constexpr int kSteps = 24;
  const Lanes span = farthest * Lanes(1.0F / kSteps), ahead = max(-direction.z, 0.01F);
  const Lanes thick = Lanes(2) * span * ahead;
  MeshHit hit{Lanes(0.0F) > Lanes(0.0F), 0.0F, {0.0F, 0.0F, 0.0F}};
  for (int k = 0; k < kSteps && any(wanted & ~hit.meets); ++k) {
    const Mask searches = ~hit.meets;
    hit.way = select(searches, hit.way + span, hit.way);
    const BehindMesh behind = behind_mesh(scene, meshes, p, p + hit.way * direction);
    hit.light = select(searches, behind.light, hit.light);
    hit.meets = hit.meets | (Mask(Lanes(0.0F) <= behind.way) & (behind.way < thick));
  }
  for (int k = 0; k < 2 && any(wanted & hit.meets); ++k) {
    const BehindMesh behind = behind_mesh(scene, meshes, p, p + hit.way * direction);
    const Mask is_nearer = abs(behind.way) < thick;
    hit.light = select(is_nearer, behind.light, hit.light);
    hit.way -= select(is_nearer, behind.way / ahead, 0.0F);
  }
  return hit;
}

}  // namespace pbf::PBF_ISA_NAMESPACE
