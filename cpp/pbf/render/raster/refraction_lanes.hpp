#pragma once

#include "pbf/render/raster/tank_lanes.hpp"

// The half of glsl/composite.frag that follows a ray through the fluid.
namespace pbf::PBF_ISA_NAMESPACE {

// In the fluid; shorter ones count as this [sprites' radii].
inline constexpr float kLeastWay = 1e-4F;
// A bent ray's way to the far side, in that of the straight one.
inline constexpr float kFarthest = 1.5F;
inline constexpr int kBounces = 3;  // of a ray in a tank: as many as a corner has walls

PBF_INLINE Lanes fresnel(Lanes c, float index) {
  const Lanes g = sqrt(max(Lanes(index * index - 1) + c * c, 1e-6F));
  const Lanes a = (g - c) / (g + c);
  const Lanes b = (c * (g + c) - Lanes(1)) / (c * (g - c) + Lanes(1));
  return Lanes(0.5F) * a * a * (Lanes(1) + b * b);
}

/// A ray of light, followed backwards.
struct Ray {
  Vec3Lanes at;         // world space [m]
  Vec3Lanes direction;  // unit vector
  Lanes way;            // length in the fluid so far [m]
};

/// Thickness over the length from the front to the far side, without what spheres stick out by
/// before and behind: what is less is air between. @param end  no farther than this [m]
PBF_INLINE Lanes filling(const FluidTerms& terms, Lanes thickness, Lanes length, Lanes end) {
  const Lanes sticking_out = min(1.2F * terms.radius, Lanes(0.5F) * length);
  return thickness / max(min(length - sticking_out, end), kLeastWay * terms.radius);
}

PBF_INLINE Lanes inside_fluid(const Scene& scene,
                              const FluidTerms& terms,
                              const Ray& ray,
                              Lanes way) {
  const FrameTerms& frame = scene.frame;
  const Vec3Lanes at = to_eye(frame, ray.at + way * ray.direction - lanes(scene.environment.eye));
  const PixelLanes pixel = pixel_of(frame, at);
  const Ints x = to_ints(clamp(pixel.x, 0.0F, frame.width - 1));
  const Ints y = to_ints(clamp(pixel.y, 0.0F, frame.height - 1));
  const Lanes front = fetch(terms.depth, x, y);
  const Lanes behind = -at.z - depth_of(frame, front);
  const Lanes before = depth_of(frame, fetch(terms.back, x, y)) + at.z;
  const Lanes length = behind + before;
  const Lanes filled = filling(terms, fetch(terms.thickness, x, y), length, length);
  const Lanes inside =
      min(min(behind, before) * Lanes(1 / terms.radius) + Lanes(1), Lanes(2) * filled - Lanes(1));
  const Mask is_fluid = is_surface(front) & (at.z < Lanes(0.0F));
  return select(is_fluid, clamp(inside, -1.0F, 1.0F), -1.0F);
}

struct Bracket {
  Lanes from, to, at_from, at_to;
};
PBF_INLINE Lanes middle(const Bracket& b) { return Lanes(0.5F) * (b.from + b.to); }
PBF_INLINE Bracket next(Mask on, const Bracket& b, Lanes to, Lanes at_to) {
  return {select(on, b.to, b.from), select(on, to, b.to), select(on, b.at_to, b.at_from),
          select(on, at_to, b.at_to)};
}
PBF_INLINE Bracket halved(const Bracket& b, Lanes at_middle) {
  const Mask is_in = at_middle > Lanes(0.0F);
  return {select(is_in, middle(b), b.from), select(is_in, b.to, middle(b)),
          select(is_in, at_middle, b.at_from), select(is_in, b.at_to, at_middle)};
}
PBF_INLINE Lanes crossing(const Bracket& b) {
  return mix(b.from, b.to, b.at_from / max(b.at_from - b.at_to, 1e-20F));
}

/// @param most  0 where nobody asks
PBF_INLINE Lanes way_inside(const Scene& scene,
                            const FluidTerms& terms,
                            const Ray& ray,
                            Lanes most) {
  constexpr int kSteps = 6;
  const Lanes zero = 0.0F;
  Bracket exit = {zero, zero, 1.0F, 1.0F};
  Mask on = most > zero;
  for (int k = 1; k <= kSteps && any(on); ++k) {
    const Lanes to = most * Lanes(static_cast<float>(k * k) / (kSteps * kSteps));
    exit = next(on, exit, to, inside_fluid(scene, terms, ray, to));
    on = on & (exit.at_to > zero);
  }
  const Mask leaves = ~(exit.at_to > zero);
  if (!any(leaves)) return most;
  for (int k = 0; k < 4; ++k) exit = halved(exit, inside_fluid(scene, terms, ray, middle(exit)));
  return select(leaves, crossing(exit), most);
}

PBF_INLINE void follow_to_wall_or_floor(const Scene& scene, const FluidTerms& terms, Ray& ray) {
  const Environment& e = scene.environment;
  const Vec3Lanes up = lanes(e.up);
  const float index = terms.refractive_index;
  const Lanes zero = 0.0F;
  Mask inside = zero <= zero, off_bottom = zero < zero;
  for (int k = 0; k < kBounces && any(inside); ++k) {
    const Lanes to_floor = distance_to_ground(e, terms, ray.at, ray.direction);
    const Wall wall = nearest_wall(e, terms, ray.at, ray.direction);
    const Lanes to_end = min(to_floor, wall.way);
    const Lanes way = select(inside & is_met(to_end), to_end, zero);
    const Lanes to_surface = k == 0 ? way : way_inside(scene, terms, ray, way);
    ray.way += select(off_bottom, way, to_surface);
    ray.at += way * ray.direction;
    if (any(off_bottom)) {
      const Lanes steep = min(to_surface / max(way, kLeastWay * terms.radius), 1.0F);
      const Lanes level = select(off_bottom, Lanes(1) - steep * steep, zero);
      ray.direction = normalize(ray.direction - (level * dot(ray.direction, up)) * up);
    }
    const Vec3Lanes bent = refract(ray.direction, -wall.outward, index);
    const Mask mirrors = dot(bent, bent) < Lanes(0.5F);
    inside = inside & (wall.way < to_floor);
    const Vec3Lanes on = select(mirrors, reflect(ray.direction, wall.outward), bent);
    ray.direction = select(inside, on, ray.direction);
    inside = inside & mirrors;
    off_bottom = inside & (off_bottom | (dot(wall.outward, up) < Lanes(-0.5F)));
  }
}

PBF_INLINE Vec3Lanes
back_at(const Scene& scene, const FluidTerms& terms, Ints x, Ints y, Lanes else_at) {
  x = clamp(x, 0, terms.back.width - 1);
  y = clamp(y, 0, terms.back.height - 1);
  const Lanes a = fetch(terms.back, x, y);
  const Lanes depth = select(is_surface(a), depth_of(scene.frame, a), else_at);
  return eye_position(scene.frame, to_lanes(x) + Lanes(0.5F), to_lanes(y) + Lanes(0.5F), depth);
}

PBF_INLINE Vec3Lanes
back_normal(const Scene& scene, const FluidTerms& terms, Ints x, Ints y, Lanes depth) {
  const Lanes pixels = Lanes(0.7F * terms.radius) * pixels_per_meter(scene.frame, depth);
  const Ints apart = to_ints(max(min(pixels, 1e6F), 1.0F));
  const auto within = [&](Ints at, int size) PBF_LAMBDA_INLINE {
    const Ints most = size - 1 - apart;
    const Ints high = most > apart ? most : apart;
    at = at < apart ? apart : at;
    return at > high ? high : at;
  };
  x = within(x, terms.back.width);
  y = within(y, terms.back.height);
  Vec3Lanes right =
      back_at(scene, terms, x + apart, y, depth) - back_at(scene, terms, x - apart, y, depth);
  Vec3Lanes up =
      back_at(scene, terms, x, y + apart, depth) - back_at(scene, terms, x, y - apart, depth);
  const Lanes most = Lanes(2) * right.x;
  right.z = clamp(right.z, -most, most);
  up.z = clamp(up.z, -most, most);
  const Vec3Lanes n = cross(right, up);
  return normalize(Vec3Lanes{n.x, n.y, n.z + Lanes(1e-9F * terms.radius * terms.radius)});
}

/// How far rays from points go to the first far side that they meet, `most` if not so far.
/// @param deep  how far before the far side they begin, more than 0 [m]
PBF_INLINE Lanes way_to_back(const Scene& scene,
                             const FluidTerms& terms,
                             const Vec3Lanes& p,
                             const Vec3Lanes& into,
                             Lanes most,
                             Lanes deep,
                             Mask wanted) {
  constexpr int kSteps = 6;
  const FrameTerms& frame = scene.frame;
  const Lanes zero = 0.0F;
  const auto before_back = [&](Lanes way) PBF_LAMBDA_INLINE {
    const Vec3Lanes point = p + way * into;
    const PixelLanes at = pixel_of(frame, point);
    const Ints x = to_ints(clamp(at.x, 0.0F, frame.width - 1));
    const Ints y = to_ints(clamp(at.y, 0.0F, frame.height - 1));
    return point.z - back_at(scene, terms, x, y, -point.z).z;
  };
  if (!any(wanted)) return most;
  const Lanes at_most = before_back(most);
  const Mask leaves = ~(at_most > zero);
  Mask on = leaves & wanted;
  if (!any(on)) return most;
  Bracket back = {zero, zero, deep, deep};
  for (int k = 1; k <= kSteps && any(on); ++k) {
    const Lanes to = most * Lanes(static_cast<float>(k) / kSteps);
    back = next(on, back, to, k < kSteps ? before_back(to) : at_most);
    on = on & (back.at_to > zero);
  }
  for (int k = 0; k < 3; ++k) back = halved(back, before_back(middle(back)));
  return select(leaves, crossing(back), most);
}

PBF_INLINE Vec3Lanes out_of(const Vec3Lanes& direction, const Vec3Lanes& n, float index) {
  const Lanes c = clamp(-dot(direction, n), 0.0F, 1.0F);
  Vec3Lanes along = Lanes(index) * (direction + c * n);
  along = (Lanes(0.99F) / max(sqrt(dot(along, along)), 0.99F)) * along;
  return along - sqrt(max(Lanes(1) - dot(along, along), 0.0F)) * n;
}

/// The way through a drop [m].
PBF_INLINE Lanes chord_of_drop(const FluidTerms& terms, const Vec3Lanes& view, const Vec3Lanes& n) {
  return Lanes(2 * terms.drop_radius) * clamp(-dot(view, n), 0.0F, 1.0F);
}

/// The ray from a point of the surface to what is seen through the fluid, and its direction behind
/// the surface.
struct Refracted {
  Ray ray;
  Vec3Lanes first;
};

/// @param x, y  the pixels, of which `wanted` count   @param body  0 for a drop, 1 in a body
PBF_INLINE Refracted refracted(const Scene& scene,
                               const FluidTerms& terms,
                               Ints x,
                               Ints y,
                               const Vec3Lanes& p,
                               const Vec3Lanes& view,
                               const Vec3Lanes& n,
                               Lanes thickness,
                               Lanes body,
                               Mask wanted) {
  const Environment& e = scene.environment;
  const FrameTerms& frame = scene.frame;
  const float index = terms.refractive_index, eta = 1 / index;
  const Vec3Lanes into = refract(view, n, eta);
  const Vec3Lanes once = to_world(frame, into);
  const Vec3Lanes position = lanes(e.eye) + to_world(frame, p);
  const Lanes to_end =
      min(distance_to_ground(e, terms, position, once), nearest_wall(e, terms, position, once).way);
  const Lanes deep = p.z - back_at(scene, terms, x, y, -p.z).z;
  const Lanes straight = max(deep, 0.0F) / -view.z;
  const Lanes least = kLeastWay * terms.radius;
  const Mask may_be_solid = wanted & (body > Lanes(0.0F));
  const Lanes half_radius = 0.5F * terms.radius;
  const Lanes most = clamp(to_end - half_radius, 0.0F, Lanes(kFarthest) * straight + half_radius);
  const Lanes way = way_to_back(scene, terms, p, into, most, max(deep, least), may_be_solid);
  const Lanes gap = to_end - way;
  const Lanes filled = filling(terms, thickness, straight, to_end);
  const Lanes full = filling(terms, thickness + Lanes(terms.radius), straight, to_end);
  const Lanes is_bound = (Lanes(1) - smoothstep(0.5F * terms.radius, 3 * terms.radius, gap)) *
                         select(Lanes(1) <= body, smoothstep(0.55F, 0.9F, full), 0.0F);
  const Lanes solid = max(body * smoothstep(0.55F, 0.9F, filled), is_bound);
  const Vec3Lanes twice = to_world(frame, refract(view, n, eta * eta));
  Vec3Lanes direction = twice;
  if (any((solid > Lanes(0.0F)) & (is_bound < Lanes(1)) & wanted)) {
    const PixelLanes at = pixel_of(frame, p + way * into);
    x = to_ints(floor(clamp(at.x, -1.0F, frame.width)));
    y = to_ints(floor(clamp(at.y, -1.0F, frame.height)));
    const Vec3Lanes far_side = back_normal(scene, terms, x, y, way - p.z);
    direction = mix(twice, to_world(frame, out_of(into, far_side, index)), solid);
  }
  const Lanes longer = min(way / max(straight, least), kFarthest);
  const Lanes length = mix(thickness, longer * thickness, solid);
  const Lanes leaves = mix(chord_of_drop(terms, view, n), way, body);
  Ray ray{position + leaves * once, direction, length};
  if (any((is_bound > Lanes(0.0F)) & wanted)) {
    Ray bound{position, once, 0.0F};
    follow_to_wall_or_floor(scene, terms, bound);
    ray.at = mix(ray.at, bound.at, is_bound);
    ray.direction = mix(ray.direction, bound.direction, is_bound);
    const Lanes to_bound = min(to_end, bound.way);
    const Lanes goes_on = smoothstep(0.45F, 0.7F, filled);
    const Lanes bound_length = to_bound * min(full, 1.0F) + (bound.way - to_bound) * goes_on;
    ray.way = mix(ray.way, bound_length, is_bound);
  }
  ray.direction = normalize(ray.direction);
  return {ray, normalize(mix(twice, once, solid))};
}

}  // namespace pbf::PBF_ISA_NAMESPACE
