#pragma once

#include "pbf/render/raster/composite_kernels.hpp"
#include "pbf/render/raster/environment_lanes.hpp"

// Of glsl/composite.frag what rays in the fluid see of meshes.
namespace pbf::PBF_ISA_NAMESPACE {

using raster::MeshTexels;

/// Where points of rays lie in the picture of the meshes.
struct MeshPoint {
  Lanes depth;  // of the mesh there, kNowhere without one [m]
  Vec3Lanes light;
};
PBF_INLINE MeshPoint mesh_at(const Scene& scene, const MeshTexels& meshes, const Vec3Lanes& point) {
  const FrameTerms& frame = scene.frame;
  const PixelLanes at = pixel_of(frame, point);
  const Ints x = to_ints(clamp(at.x, 0.0F, frame.width - 1));
  const Ints y = to_ints(clamp(at.y, 0.0F, frame.height - 1));
  const Lanes a = fetch(meshes.depth, x, y);
  return {select(is_surface(a), depth_of(frame, a), kNowhere), fetch(meshes.light, x, y)};
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
  MeshPoint last{kNowhere, {0.0F, 0.0F, 0.0F}};
  for (int k = 0; k < kSteps && any(wanted & ~hit.meets); ++k) {
    hit.way = select(hit.meets, hit.way, hit.way + span);
    const Vec3Lanes point = p + hit.way * direction;
    const MeshPoint mesh = mesh_at(scene, meshes, point);
    const Mask hides = (mesh.depth <= -p.z) | (mesh.depth <= -point.z - thick);
    const Mask goes_on = hides | hit.meets;
    last = {select(goes_on, last.depth, mesh.depth), select(goes_on, last.light, mesh.light)};
    hit.meets = hit.meets | (Mask(last.depth <= -point.z) & (last.depth > -point.z - thick));
  }
  hit.light = last.light;
  for (int k = 0; k < 2 && any(wanted & hit.meets); ++k) {
    const Vec3Lanes point = p + hit.way * direction;
    const MeshPoint mesh = mesh_at(scene, meshes, point);
    const Lanes behind = -point.z - mesh.depth;
    const Mask is_nearer = (abs(behind) < thick) & (mesh.depth > -p.z);
    hit.light = select(is_nearer, mesh.light, hit.light);
    hit.way -= select(is_nearer, behind / ahead, 0.0F);
  }
  return hit;
}

}  // namespace pbf::PBF_ISA_NAMESPACE
