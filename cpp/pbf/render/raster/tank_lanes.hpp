#pragma once

#include "pbf/render/raster/composite_kernels.hpp"
#include "pbf/render/raster/environment_lanes.hpp"

// Of glsl/composite.frag what happens at the tank's walls.
namespace pbf::PBF_ISA_NAMESPACE {

using raster::FluidTerms;
using raster::Texels;

struct Wall {
  Lanes way;          // kNowhere if there is none
  Vec3Lanes outward;  // unit vector
};

PBF_INLINE Wall nearest_wall(const Environment& e,
                             const Vec3Lanes& point,
                             const Vec3Lanes& direction) {
  if (!e.has_tank) return {kNowhere, {0.0F, 0.0F, 0.0F}};
  struct Side {
    Lanes way, sign;
  };
  const auto side = [](Lanes at, Lanes along, float low, float high, float up)
                        PBF_LAMBDA_INLINE -> Side {
    const Mask ahead = ~(along < Lanes(0.0F));
    const Lanes face = select(ahead, high, low);
    const Lanes sign = select(ahead, 1.0F, -1.0F);
    const Lanes way = (face - clamp(at, low, high)) / (sign * max(abs(along), 1e-6F));
    const bool none = up >= 0.9F || up <= -0.9F;
    return {way + Lanes(none ? kNowhere : 0.0F), sign};
  };
  const Side x = side(point.x, direction.x, e.tank_lower.x, e.tank_upper.x, e.up.x);
  const Side y = side(point.y, direction.y, e.tank_lower.y, e.tank_upper.y, e.up.y);
  const Side z = side(point.z, direction.z, e.tank_lower.z, e.tank_upper.z, e.up.z);
  const Lanes nearest = min(x.way, min(y.way, z.way));
  const auto outward = [&](const Side& of)
                           PBF_LAMBDA_INLINE { return select(of.way <= nearest, of.sign, 0.0F); };
  return {nearest, {outward(x), outward(y), outward(z)}};
}

PBF_INLINE Lanes distance_to_ground(const Environment& e,
                                    const Vec3Lanes& point,
                                    const Vec3Lanes& direction) {
  const Lanes to_floor = distance_to_floor(e, point, direction);
  if (!e.has_tank) return to_floor;
  const Vec3Lanes up = lanes(e.up);
  const Lanes bottom = min(dot(lanes(e.tank_lower), up), dot(lanes(e.tank_upper), up));
  const Lanes down = -dot(direction, up);
  const Lanes to_bottom = max(dot(point, up) - bottom, 0.0F) / max(down, 1e-4F);
  return min(select(down > Lanes(1e-4F), to_bottom, kNowhere), to_floor);
}

/// A body's spheres stick out of the tank, but fluid ends at its walls: the share of the pixels
/// that is fluid, of which p and n move there.
/// @param back  length of the ray's way to the far side [m]
PBF_INLINE Lanes cut_at_walls(const Scene& scene,
                              const FluidTerms& terms,
                              Vec3Lanes& p,
                              const Vec3Lanes& view,
                              Lanes back,
                              Lanes body,
                              Vec3Lanes& n) {
  const Environment& e = scene.environment;
  const FrameTerms& frame = scene.frame;
  if (!e.has_tank) return 1.0F;
  const Vec3Lanes point = lanes(e.eye) + to_world(frame, p), direction = to_world(frame, view);
  struct Slab {
    Lanes outside, to_near, to_far, sign, beside;
  };
  const float radius = terms.radius;
  const auto slab = [&](Lanes at, Lanes along, float low, float high, float up)
                        PBF_LAMBDA_INLINE -> Slab {
    const Mask ahead = ~(along < Lanes(0.0F));
    const Lanes sign = select(ahead, 1.0F, -1.0F);
    const Lanes speed = max(abs(along), 1e-5F), inverse = sign / speed;
    const Lanes open = up >= 0.9F || up <= -0.9F ? 1.0F : 0.0F;
    const Lanes to_far = (select(ahead, high, low) - at) * inverse + Lanes(kNowhere) * open;
    return {(Lanes(1) - open) * max(Lanes(low) - at, at - Lanes(high)),
            (select(ahead, low, high) - at) * inverse - Lanes(kNowhere) * open, to_far, sign,
            (Lanes(1) - smoothstep(1.0F, 3.0F, to_far * speed * Lanes(1 / radius))) * sign};
  };
  const Slab x = slab(point.x, direction.x, e.tank_lower.x, e.tank_upper.x, e.up.x);
  const Slab y = slab(point.y, direction.y, e.tank_lower.y, e.tank_upper.y, e.up.y);
  const Slab z = slab(point.z, direction.z, e.tank_lower.z, e.tank_upper.z, e.up.z);
  const Lanes outside = max(x.outside, max(y.outside, z.outside));
  const Mask cuts = (Lanes(1) <= body) & (outside <= Lanes(terms.radius));
  if (!any(cuts)) return 1.0F;
  const Lanes enters = max(x.to_near, max(y.to_near, z.to_near));
  Lanes leaves = min(x.to_far, min(y.to_far, z.to_far));
  // It stands at the far wall as at the floor: up to the glass, without curling away from it.
  const Vec3Lanes beside{x.beside, y.beside, z.beside}, world_n = to_world(frame, n);
  const auto outwards = [](Lanes a, Lanes b) PBF_LAMBDA_INLINE { return b * max(a * b, 0.0F); };
  const Vec3Lanes flat_n =
      world_n - Vec3Lanes{outwards(world_n.x, beside.x), outwards(world_n.y, beside.y),
                          outwards(world_n.z, beside.z)};
  n = select(cuts, normalize(to_eye(frame, flat_n - Lanes(1e-6F) * direction)), n);
  const Mask moves = cuts & (enters > Lanes(0.0F));
  if (any(moves)) {
    p += select(moves, enters, 0.0F) * view;
    const auto wall = [&](const Slab& of) PBF_LAMBDA_INLINE {
      return select(enters <= of.to_near, -of.sign, 0.0F);
    };
    n = select(moves, to_eye(frame, {wall(x), wall(y), wall(z)}), n);
    leaves = select(moves, min(leaves, back) - enters, leaves);
  }
  const Lanes pixels = leaves * pixels_per_meter(frame, -p.z);
  return select(cuts, clamp(Lanes(0.5F) + Lanes(0.5F) * pixels, 0.0F, 1.0F), 1.0F);
}

}  // namespace pbf::PBF_ISA_NAMESPACE
