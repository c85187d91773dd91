// Compiled once per instruction set (cpp/pbf_render.cmake).
#include "pbf/render/raster/composite_kernels.hpp"
#include "pbf/render/raster/fluid_lanes.hpp"
#include "pbf/render/raster/sphere_shading_lanes.hpp"
#include "pbf/render/raster/tank_edges_lanes.hpp"

namespace pbf::PBF_ISA_NAMESPACE {
namespace {

using raster::CompositeKernels;

/// Whether any of these rays meets the floor in the shadow.
PBF_INLINE bool is_in_shadow(const Scene& scene, const Vec3Lanes& origin, const Vec3Lanes& ray) {
  const Environment& e = scene.environment;
  const Lanes way = distance_to_floor(e, origin, ray);
  const Mask meets = is_met(way);
  if (!any(meets)) return false;
  const Vec3Lanes light = sunlight(scene, origin + select(meets, way, 0.0F) * ray);
  return any(meets & (min(light.x, min(light.y, light.z)) < Lanes(1)));
}

void backdrop(const Scene& scene, Tile tile, const Picture& picture) {
  const Environment& e = scene.environment;
  const Mask all = Lanes(0.0F) <= Lanes(0.0F);
  for_pixels(tile, picture.width, picture.height, [&](int x, int y) PBF_LAMBDA_INLINE {
    const View view = view_of(scene.frame, x, y);
    const Vec3Lanes origin =
        lanes(e.eye) + to_world(scene.frame, ray_origin(scene.frame, view.x, view.y));
    const Vec3Lanes ray = to_world(scene.frame, view.direction);
    if (scene.shadow.first != nullptr && !is_in_shadow(scene, origin, ray)) return;
    const RgbaLanes light = environment(scene, e.backdrop, origin, ray, 0.0F, 1, all);
    store_pixels(picture, x, y, packed(display(e, light.rgb, light.a)));
  });
}

void meshes(const Scene& scene, const MeshTexels& meshes, Tile tile, const Picture& picture) {
  for_pixels(tile, picture.width, picture.height, [&](int x, int y) PBF_LAMBDA_INLINE {
    const Mask exist = is_surface(load_at(meshes.depth, x, y));
    if (!any(exist)) return;
    const Ints color = packed(display(scene.environment, load_at(meshes.light, x, y), 1.0F));
    store_pixels(picture, x, y, exist.v ? color : load_pixels(picture, x, y));
  });
}

void fluid_tile(const Scene& scene, const FluidTerms& terms, Tile tile, const Picture& picture) {
  for_pixels(tile, picture.width, picture.height,
             [&](int x, int y) PBF_LAMBDA_INLINE { draw_fluid(scene, terms, picture, x, y); });
}

void spheres(const Scene& scene, const SphereTerms& terms, Tile tile, const Picture& picture) {
  for_pixels(tile, picture.width, picture.height,
             [&](int x, int y) PBF_LAMBDA_INLINE { draw_spheres(scene, terms, picture, x, y); });
}

void tank_edges(const TankEdgeTerms& terms, Tile tile, const Picture& picture) {
  for (int k = 0; k < terms.count; ++k) {
    draw_tank_edge(terms, terms.edges[k], tile, picture);
  }
}

void resolve(const Picture& picture, int factor, int y, const Picture& out) {
  const Ints last = out.width - 1 - Ints{};
  for (int x = 0; x < out.width; x += kLanes) {
    Ints column = lane_numbers() + x;
    column = factor * (column < last ? column : last);
    RgbaLanes sum{{0.0F, 0.0F, 0.0F}, 0.0F};
    for (int k = 0; k < factor * factor; ++k) {
      const std::uint32_t* row = picture.row(factor * y + k / factor) + k % factor;
      Ints pixel;
      for (int lane = 0; lane < kLanes; ++lane) {
        pixel[lane] = static_cast<std::int32_t>(row[column[lane]]);
      }
      const RgbaLanes light = unpacked(picture, pixel);
      sum = {sum.rgb + light.rgb, sum.a + light.a};
    }
    const Lanes share = static_cast<float>(factor * factor);
    const Lanes alpha = sum.a / share;
    store_pixels(out, x, y, packed({(Lanes(1) / (share * max(alpha, 1e-6F))) * sum.rgb, alpha}));
  }
}

}  // namespace

const CompositeKernels& composite_kernels() {
  static constexpr CompositeKernels kernels{backdrop, meshes,     fluid_tile,
                                            spheres,  tank_edges, resolve};
  return kernels;
}

}  // namespace pbf::PBF_ISA_NAMESPACE
