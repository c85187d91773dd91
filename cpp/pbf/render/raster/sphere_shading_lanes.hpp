#pragma once

#include "pbf/render/raster/composite_kernels.hpp"
#include "pbf/render/raster/display_lanes.hpp"
#include "pbf/render/raster/view_lanes.hpp"

// glsl/sphere_shading.frag, where the formulas are explained.
namespace pbf::PBF_ISA_NAMESPACE {

using raster::SphereTerms;

PBF_INLINE Lanes openness(const FrameTerms& frame,
                          const SphereTerms& terms,
                          int x,
                          int y,
                          const Vec3Lanes& p,
                          const Vec3Lanes& n) {
  constexpr float kReach = 5, kStrength = 5;
  const float reach = kReach * terms.radius;
  const Lanes disk = min(Lanes(reach) * pixels_per_meter(frame, -p.z), Lanes(0.25F * frame.height));
  Lanes sum = 0.0F;
  for (int k = 0; k < SphereTerms::kTaps; ++k) {
    const Ints column =
        clamp(lane_numbers() + x + to_ints(disk * load_lanes(terms.tap_x[k][y & 3])), 0,
              terms.depth.width - 1);
    const Ints row = clamp(Ints{} + y + to_ints(disk * load_lanes(terms.tap_y[k][y & 3])), 0,
                           terms.depth.height - 1);
    const Lanes a = fetch(terms.depth, column, row);
    const Mask exists = is_surface(a);
    const Vec3Lanes v =
        eye_position(frame, to_lanes(column) + Lanes(0.5F), to_lanes(row) + Lanes(0.5F),
                     select(exists, depth_of(frame, a), 1.0F)) -
        p;
    const Lanes d2 = dot(v, v);
    const Lanes fade = select(exists, max(Lanes(1) - d2 * Lanes(1 / (reach * reach)), 0.0F), 0.0F);
    sum += fade * max(dot(v, n) - Lanes(0.05F * terms.radius), 0.0F) /
           (d2 + Lanes(0.01F * terms.radius * terms.radius));
  }
  return clamp(Lanes(1) - Lanes(kStrength * terms.radius / SphereTerms::kTaps) * sum, 0.0F, 1.0F);
}

PBF_INLINE void draw_spheres(
    const Scene& scene, const SphereTerms& terms, const Picture& picture, int x, int y) {
  constexpr float kSun = 0.60F, kSky = 0.40F, kGround = 0.22F;
  const Environment& e = scene.environment;
  const FrameTerms& frame = scene.frame;
  const Lanes a = load_at(terms.depth, x, y);
  const Mask exists = is_surface(a) & Mask{lane_numbers() + x < picture.width};
  if (!any(exists)) return;
  const View view = view_of(frame, x, y);
  const Vec3Lanes p = eye_position(frame, view.x, view.y, select(exists, depth_of(frame, a), 1.0F));
  Mask wanted = exists & ~is_below_floor(e, lanes(e.eye) + to_world(frame, p));
  if (terms.meshes.exist) wanted = wanted & (load_at(terms.meshes.depth, x, y) <= a);
  if (!any(wanted)) return;
  const Vec3Lanes eye_n = load_at(terms.normal, x, y), n = to_world(frame, eye_n);
  const Lanes sun = Lanes(kSun) * max(dot(n, lanes(e.sun)), 0.0F);
  const Lanes sky = mix(kGround, kSky, Lanes(0.5F) + Lanes(0.5F) * dot(n, lanes(e.up)));
  const Lanes open = openness(frame, terms, x, y, p, eye_n);
  const Ints color = reinterpret_cast<Ints>(load_at(terms.color, x, y).v);
  const auto channel = [&](int shift) PBF_LAMBDA_INLINE {
    return fetch(picture.light, (color >> shift) & 255);
  };
  const Lanes lit = sun * mix(0.5F, 1.0F, open) + sky * open;
  const RgbaLanes shown = display(e, lit * Vec3Lanes{channel(16), channel(8), channel(0)}, 1.0F);
  blend_over(picture, x, y, shown, wanted);
}

}  // namespace pbf::PBF_ISA_NAMESPACE
