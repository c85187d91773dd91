#pragma once

#include "pbf/render/raster/display_lanes.hpp"
#include "pbf/render/raster/mesh_lanes.hpp"
#include "pbf/render/raster/refraction_lanes.hpp"
#include "pbf/render/raster/view_lanes.hpp"

// glsl/composite.frag but for the refracted ray, where the formulas are explained.
namespace pbf::PBF_ISA_NAMESPACE {

using raster::Tile;

inline constexpr float kSpread = 3;  // of rays from a body's surface, in that of a pixel

/// Share of the 3x3 pixels around that hold fluid, with more weight in the middle.
PBF_INLINE Lanes coverage(const Texels& depth, int x, int y) {
  const Ints column = lane_numbers() + x;
  const Mask at_left = {column == 0}, at_right = {column == depth.width - 1};
  const auto row = [&](int at) PBF_LAMBDA_INLINE {
    at = at < 0 ? 0 : at < depth.height ? at : depth.height - 1;
    const auto there = [&](int dx) PBF_LAMBDA_INLINE {
      return select(is_surface(load_at(depth, x + dx, at)), 1.0F, 0.0F);
    };
    const Lanes middle = there(0);
    return Lanes(2) * middle + select(at_left, middle, there(-1)) +
           select(at_right, middle, there(1));
  };
  return (row(y - 1) + Lanes(2) * row(y) + row(y + 1)) * Lanes(1.0F / 16);
}

/// What a drop hides: the mean of four normals around it, where fluid is farther away.
PBF_INLINE Vec3Lanes
normal_behind(const Scene& scene, const FluidTerms& terms, Ints x, Ints y, Lanes depth) {
  Vec3Lanes sum{0.0F, 0.0F, 0.0F};
  const Lanes pixels = Lanes(2.5F * terms.drop_radius) * pixels_per_meter(scene.frame, depth);
  const Ints away = to_ints(min(pixels, 1e6F)) + 2;
  const Ints zero{};
  for (int k = 0; k < 4; ++k) {
    const Ints side = (k & 1) == 0 ? away : -away;
    const Ints column = clamp(x + (k < 2 ? side : zero), 0, terms.depth.width - 1);
    const Ints row = clamp(y + (k < 2 ? zero : side), 0, terms.depth.height - 1);
    const Lanes a = fetch(terms.depth, column, row);
    const Mask farther =
        is_surface(a) & (depth_of(scene.frame, a) > depth + Lanes(2 * terms.drop_radius));
    sum += select(farther, fetch(terms.normal, column, row), Vec3Lanes{0.0F, 0.0F, 0.0F});
  }
  return Lanes(0.25F) * sum;
}

/// What the surface behind a drop adds to the drop.
struct Behind {
  Vec3Lanes mirrored;   // share of its light that the surface mirrors
  Vec3Lanes direction;  // where that comes from
  Lanes way;            // through the fluid behind, over that straight on
  Lanes meets;          // how far what the drop mirrors is that surface
};

PBF_INLINE Behind behind_drop(const FluidTerms& terms,
                              const Vec3Lanes& view,
                              const Vec3Lanes& n,
                              const Vec3Lanes& hidden,
                              Lanes body) {
  const float index = terms.refractive_index;
  const Lanes known2 = dot(hidden, hidden), share = (Lanes(1) - body) * known2;
  const Vec3Lanes normal = (Lanes(1) / sqrt(max(known2, 1e-12F))) * hidden;
  const Lanes c = clamp(-dot(view, normal), 0.0F, 1.0F);
  const Lanes bent = sqrt(Lanes(1) - (Lanes(1) - c * c) * Lanes(1 / (index * index)));
  const Vec3Lanes passes = exp(-chord_of_drop(terms, view, n) * lanes(terms.absorption));
  const Lanes onto = -dot(reflect(view, n), normal);
  return {(share * fresnel(c, index)) * passes, reflect(view, normal),
          mix(1.0F, c / max(bent, 1e-6F), share),
          select(body < Lanes(1), known2 * smoothstep(0.0F, 0.3F, onto), 0.0F)};
}

/// How far rays that are a pixel apart are from one another [pixels] where the surface has mirrored
/// them.
PBF_INLINE Lanes mirrored_spread(const Scene& scene, const FluidTerms& terms, int x, int y) {
  const int above = y + 1 < terms.depth.height ? y + 1 : y, below = y > 0 ? y - 1 : y;
  const Ints column = lane_numbers() + x;
  const Mask at_left = {column <= 0}, at_right = {column >= terms.depth.width - 1};
  const Vec3Lanes n = load_at(terms.normal, x, y);
  const auto turn2 = [&](int to_x, int to_y) PBF_LAMBDA_INLINE {
    const Vec3Lanes turn = load_at(terms.normal, to_x, to_y) - n;
    return dot(turn, turn);
  };
  const Lanes next = select(at_right, 0.0F, turn2(x + 1, y));
  const Lanes previous = select(at_left, 0.0F, turn2(x - 1, y));
  const Lanes sum = min(next, previous) + min(turn2(x, above), turn2(x, below));
  return sqrt(Lanes(0.5F) * sum) * Lanes(2 * pixels_per_radian(scene.frame));
}

PBF_INLINE Vec3Lanes upright_at_floor(const Scene& scene,
                                      const FluidTerms& terms,
                                      const Vec3Lanes& n,
                                      const Vec3Lanes& position) {
  const Environment& e = scene.environment;
  if (!e.has_floor) return normalize(n);
  const Vec3Lanes up = to_eye(scene.frame, lanes(e.up));
  const Lanes height = height_above_floor(e, position) * Lanes(1 / terms.radius);
  const Lanes nearness = Lanes(1) - smoothstep(1.0F, 3.0F, height);
  return normalize(n - (nearness * min(dot(n, up), 0.0F)) * up);
}

/// Color of the fluid itself: its own, or by its particles' values.
PBF_INLINE Vec3Lanes body_color(const FluidTerms& terms, const View& view) {
  if (!terms.has_tint) return lanes(terms.scatter);
  const Texels& weight = terms.tint[3];
  const auto place = [](Lanes at, int texels, int pixels) PBF_LAMBDA_INLINE {
    const float scale = static_cast<float>(texels) / static_cast<float>(pixels);
    return max(at * Lanes(scale) - Lanes(0.5F), 0.0F);
  };
  const Lanes at_x = place(view.x, weight.width, terms.depth.width);
  const Lanes at_y = place(view.y, weight.height, terms.depth.height);
  const Ints left = clamp(to_ints(at_x), 0, weight.width - 1);
  const Ints low = clamp(to_ints(at_y), 0, weight.height - 1);
  const Ints right = clamp(left + 1, 0, weight.width - 1);
  const Ints high = clamp(low + 1, 0, weight.height - 1);
  const Lanes share_x = min(at_x - to_lanes(left), 1.0F);
  const Lanes share_y = min(at_y - to_lanes(low), 1.0F);
  const auto sum = [&](const Texels& from) PBF_LAMBDA_INLINE {
    return mix(mix(fetch(from, left, low), fetch(from, left, high), share_y),
               mix(fetch(from, right, low), fetch(from, right, high), share_y), share_x);
  };
  const Lanes inverse = Lanes(1) / max(sum(weight), 1e-20F);
  return inverse * Vec3Lanes{sum(terms.tint[0]), sum(terms.tint[1]), sum(terms.tint[2])};
}

/// Of kLanes pixels of fluid.
struct SurfacePoint {
  Vec3Lanes p, n;  // eye space
  Lanes thickness;
  Lanes to_mesh;  // length of the straight way to a mesh [m]
  Lanes body;     // 0 for a drop, 1 in a body of fluid
  Mask wanted;    // pixels that count
};

/// Light from the surface, and how much of that of a transparent background comes through.
struct Shade {
  Vec3Lanes light, clear;
};

PBF_INLINE Shade fluid(const Scene& scene,
                       const FluidTerms& terms,
                       int x,
                       int y,
                       const View& pixel,
                       const SurfacePoint& at) {
  const Environment& e = scene.environment;
  const FrameTerms& frame = scene.frame;
  const Vec3Lanes& view = pixel.direction;
  const Ints column = lane_numbers() + x, row = Ints{} + y;
  const Lanes depth = -at.p.z;
  const Vec3Lanes position = lanes(e.eye) + to_world(frame, at.p);
  const Vec3Lanes n = upright_at_floor(scene, terms, at.n, position);
  Lanes mirrored = fresnel(clamp(-dot(view, n), 0.0F, 1.0F), terms.refractive_index) *
                   Lanes(terms.has_tint ? 0.3F : 1.0F);
  const Vec3Lanes mirror = to_world(frame, reflect(view, n));
  // A drop turns rays that are a pixel apart by a pixel's share of its radius.
  const Lanes of_drop =
      Lanes(pixels_per_radian(frame) / terms.drop_radius) * pixel_at(frame, depth);
  const Lanes spread = mix(max(of_drop, kSpread), kSpread, at.body);
  const Lanes wide = max(spread, mirrored_spread(scene, terms, x, y));
  const Vec3Lanes reflection =
      environment(scene, e.mirrored, position, mirror, depth, wide, at.wanted).rgb;
  Refracted bent =
      refracted(scene, terms, column, row, at.p, view, n, at.thickness, at.body, at.wanted);
  RgbaLanes behind =
      environment(scene, e.backdrop, bent.ray.at, bent.ray.direction, depth, spread, at.wanted);
  if (terms.meshes.exist) {
    const Lanes farthest =
        Lanes(1.3F) * max(bent.ray.way, select(is_met(at.to_mesh), at.to_mesh, 0.0F));
    const MeshHit hit =
        meet_mesh(scene, terms.meshes, at.p, to_eye(frame, bent.first), farthest, at.wanted);
    behind = select(hit.meets, RgbaLanes{hit.light, 1.0F}, behind);
    bent.ray.way = select(hit.meets, min(bent.ray.way, hit.way), bent.ray.way);
  }
  Behind also = {{0.0F, 0.0F, 0.0F}, {0.0F, 0.0F, 0.0F}, 1.0F, 0.0F};
  if (any((at.body < Lanes(1)) & at.wanted)) {
    const Vec3Lanes hidden = normal_behind(scene, terms, column, row, depth);
    also = behind_drop(terms, view, n, hidden, at.body);
    const Lanes own = min(chord_of_drop(terms, view, n), bent.ray.way);
    bent.ray.way = own + (bent.ray.way - own) * also.way;
  }
  const Vec3Lanes left = exp(-bent.ray.way * lanes(terms.absorption));
  const Vec3Lanes up_facing = to_world(frame, n);
  const Lanes lit = Lanes(0.60F) + Lanes(0.25F) * dot(up_facing, lanes(e.up)) +
                    Lanes(0.35F) * dot(up_facing, lanes(e.sun));
  const Vec3Lanes one{1.0F, 1.0F, 1.0F};
  Vec3Lanes through = behind.rgb * left + (lit * body_color(terms, pixel)) * (one - left);
  // At its rim a drop mirrors what it hides: the same as is seen through it.
  mirrored *= Lanes(1) - also.meets;
  Vec3Lanes passes = ((Lanes(1) - mirrored) * (Lanes(1) - behind.a)) * (one - also.mirrored);
  const Vec3Lanes& share = also.mirrored;
  if (any((max(share.x, max(share.y, share.z)) > Lanes(0.0F)) & at.wanted)) {
    const Vec3Lanes second = to_world(frame, also.direction);
    through += share * (light_from(scene, e.mirrored, second, kSpread).rgb - through);
  }
  return {mix(through, reflection, mirrored), passes * left};
}

PBF_INLINE void draw_fluid(
    const Scene& scene, const FluidTerms& terms, const Picture& picture, int x, int y) {
  const Environment& e = scene.environment;
  const FrameTerms& frame = scene.frame;
  const Lanes a = load_at(terms.depth, x, y);
  const Mask exists = is_surface(a) & Mask{lane_numbers() + x < picture.width};
  if (!any(exists)) return;
  const View view = view_of(frame, x, y);
  Vec3Lanes p = eye_position(frame, view.x, view.y, select(exists, depth_of(frame, a), 1.0F));
  Vec3Lanes n = load_at(terms.normal, x, y);
  // What is crowded by two thirds is a body's edge, whatever rounding makes of it.
  const Lanes body = min(Lanes(1.6F) * crowding_of(load_at(terms.spheres, x, y)), 1.0F);
  const Lanes far_side = load_at(terms.back, x, y);
  const Lanes deep = select(is_surface(far_side), depth_of(frame, far_side) + p.z, 0.0F);
  const Lanes thickness = load_at(terms.thickness, x, y);
  Lanes share = clamp(Lanes(1.8F) * coverage(terms.depth, x, y) - Lanes(0.55F), 0.0F, 1.0F) *
                smoothstep(0.1F, 0.8F, thickness * Lanes(1 / terms.sprite_thickness)) *
                cut_at_walls(scene, terms, p, view.direction, deep / -view.direction.z, body, n);
  Lanes to_mesh = kNowhere;
  Mask hidden = is_below_floor(e, lanes(e.eye) + to_world(frame, p));
  if (terms.meshes.exist) {
    const Lanes mesh = load_at(terms.meshes.depth, x, y);
    hidden = hidden | (mesh > a);
    const Lanes way = max((depth_of(frame, mesh) + p.z) / -view.direction.z, 0.0F);
    to_mesh = select(is_surface(mesh), way, to_mesh);
  }
  share = select(exists & ~hidden, share, 0.0F);
  const Mask wanted = share > Lanes(0.0F);
  if (!any(wanted)) return;
  const Shade shade = fluid(scene, terms, x, y, view, {p, n, thickness, to_mesh, body, wanted});
  const Lanes clear = min(shade.clear.x, min(shade.clear.y, shade.clear.z));
  const Vec3Lanes rest = shade.clear - Vec3Lanes{clear, clear, clear};
  const RgbaLanes shown =
      display(e, shade.light + rest * lanes(e.background_color), Lanes(1) - clear);
  blend_over(picture, x, y, {share * shown.rgb, share * shown.a}, wanted);
}

}  // namespace pbf::PBF_ISA_NAMESPACE
