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

PBF_INLINE float tank_bottom(const Environment& e) {
  const float lower = e.tank_lower.x * e.up.x + e.tank_lower.y * e.up.y + e.tank_lower.z * e.up.z;
  const float upper = e.tank_upper.x * e.up.x + e.tank_upper.y * e.up.y + e.tank_upper.z * e.up.z;
  return lower < upper ? lower : upper;
}
PBF_INLINE bool bottom_is_wall(const Environment& e, const FluidTerms& terms) {
  return !e.has_floor || tank_bottom(e) > e.floor_height + 0.5F * terms.radius;
}

PBF_INLINE Wall nearest_wall(const Environment& e,
                             const FluidTerms& terms,
                             const Vec3Lanes& point,
                             const Vec3Lanes& direction) {
  if (!e.has_tank) return {kNowhere, {0.0F, 0.0F, 0.0F}};
  const Mask goes_down = dot(direction, lanes(e.up)) < Lanes(0.0F);
  const Lanes surface =
      bottom_is_wall(e, terms) ? select(goes_down, 0.0F, kNowhere) : Lanes(kNowhere);
  struct Side {
    Lanes way, sign;
  };
  const auto side = [&](Lanes at, Lanes along, float low, float high, float up)
                        PBF_LAMBDA_INLINE -> Side {
    const Mask ahead = ~(along < Lanes(0.0F));
    const Lanes face = select(ahead, high, low);
    const Lanes sign = select(ahead, 1.0F, -1.0F);
    const Lanes way = (face - clamp(at, low, high)) / (sign * max(abs(along), 1e-6F));
    const bool none = up >= 0.9F || up <= -0.9F;
    return {way + (none ? surface : Lanes(0.0F)), sign};
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
                                    const FluidTerms& terms,
                                    const Vec3Lanes& point,
                                    const Vec3Lanes& direction) {
  const Lanes to_floor = distance_to_floor(e, point, direction);
  if (!e.has_tank || bottom_is_wall(e, terms)) return to_floor;
  const Vec3Lanes up = lanes(e.up);
  const Lanes down = -dot(direction, up);
  const Lanes to_bottom = max(dot(point, up) - Lanes(tank_bottom(e)), 0.0F) / max(down, 1e-4F);
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
    Lanes outside, to_near, to_far, speed, sign, near, far;
  };
  const float radius = terms.radius;
  const bool has_bottom = bottom_is_wall(e, terms);
  const Lanes none = 0.0F, open = kNowhere;
  const Mask goes_down = dot(direction, lanes(e.up)) < none;
  const Lanes opens_near = has_bottom ? select(goes_down, open, none) : open;
  const Lanes opens_far = has_bottom ? select(goes_down, none, open) : open;
  const auto slab = [&](Lanes at, Lanes along, float low, float high, float up)
                        PBF_LAMBDA_INLINE -> Slab {
    const Mask ahead = ~(along < Lanes(0.0F));
    const Lanes sign = select(ahead, 1.0F, -1.0F);
    const Lanes speed = max(abs(along), 1e-5F), inverse = sign / speed;
    const bool is_up = up >= 0.9F || up <= -0.9F;
    const Lanes to_far = (select(ahead, high, low) - at) * inverse + (is_up ? opens_far : none);
    const Lanes to_near = (select(ahead, low, high) - at) * inverse - (is_up ? opens_near : none);
    const auto nearness = [&](Lanes way) PBF_LAMBDA_INLINE {
      return Lanes(1) - smoothstep(2.0F, 5.0F, way * speed * Lanes(1 / radius));
    };
    return {is_up ? none : max(Lanes(low) - at, at - Lanes(high)),
            to_near,
            to_far,
            speed,
            sign,
            nearness(-to_near) * -sign,
            nearness(to_far) * sign};
  };
  const Slab x = slab(point.x, direction.x, e.tank_lower.x, e.tank_upper.x, e.up.x);
  const Slab y = slab(point.y, direction.y, e.tank_lower.y, e.tank_upper.y, e.up.y);
  const Slab z = slab(point.z, direction.z, e.tank_lower.z, e.tank_upper.z, e.up.z);
  const Lanes outside = max(x.outside, max(y.outside, z.outside));
  const Mask cuts = (Lanes(1) <= body) & (outside <= Lanes(terms.radius));
  if (!any(cuts)) return 1.0F;
  const Lanes enters = max(x.to_near, max(y.to_near, z.to_near));
  Lanes leaves = min(x.to_far, min(y.to_far, z.to_far));
  const Vec3Lanes world_n = to_world(frame, n);
  const Lanes lies = smoothstep(0.4F, 0.8F, abs(dot(world_n, lanes(e.up))));
  const auto flat = [&](Lanes a, const Slab& of) PBF_LAMBDA_INLINE {
    return a - of.far * max(a * of.far, 0.0F) - lies * of.near * max(a * of.near, 0.0F);
  };
  const Vec3Lanes flat_n{flat(world_n.x, x), flat(world_n.y, y), flat(world_n.z, z)};
  n = select(cuts, normalize(to_eye(frame, flat_n - Lanes(1e-6F) * direction)), n);
  const auto entered = [&](const Slab& of) PBF_LAMBDA_INLINE {
    return select(enters <= of.to_near, of.speed, none);
  };
  const Lanes inside = -enters * (entered(x) + entered(y) + entered(z));
  const Mask moves =
      cuts & (inside < (Lanes(1) - lies) * Lanes(radius)) & (p.z + enters * view.z < none);
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
