#pragma once

#include "pbf/render/raster/composite_kernels.hpp"
#include "pbf/render/raster/display_lanes.hpp"
#include "pbf/render/raster/view_lanes.hpp"

// glsl/tank_edges.frag.
namespace pbf::PBF_ISA_NAMESPACE {

using raster::TankEdge;
using raster::TankEdgeTerms;

PBF_INLINE void draw_tank_edge(const TankEdgeTerms& terms,
                               const TankEdge& edge,
                               raster::Tile tile,
                               const Picture& picture) {
  const float dx = edge.bx - edge.ax + 1e-6F, dy = edge.by - edge.ay;
  const float length = __builtin_sqrtf(dx * dx + dy * dy);
  const float along_x = dx / length, along_y = dy / length;
  const auto place = [&](Lanes x, Lanes y) PBF_LAMBDA_INLINE {
    const Lanes from_x = x - Lanes(edge.ax), from_y = y - Lanes(edge.ay);
    return PixelLanes{from_x * Lanes(along_x) + from_y * Lanes(along_y),
                      from_y * Lanes(along_x) - from_x * Lanes(along_y)};
  };
  constexpr float kHalf = raster::kTileSide / 2;
  const PixelLanes middle =
      place(static_cast<float>(tile.x) + kHalf, static_cast<float>(tile.y) + kHalf);
  const float reach = 1.5F * kHalf + terms.half_width;  // from the middle to a corner, and more
  if (!any((abs(middle.y) < Lanes(reach)) & (middle.x > Lanes(-reach)) &
           (middle.x < Lanes(length + reach)))) {
    return;
  }
  for_pixels(tile, picture.width, picture.height, [&](int x, int y) PBF_LAMBDA_INLINE {
    const Lanes column = to_lanes(lane_numbers() + x) + Lanes(0.5F);
    const PixelLanes at = place(column, static_cast<float>(y) + 0.5F);
    Lanes alpha = Lanes(0.72F) * clamp(Lanes(terms.half_width) - abs(at.y), 0.0F, 1.0F);
    const Mask beside = (at.x > Lanes(0.0F)) & (at.x < Lanes(length)) &
                        (column < Lanes(static_cast<float>(picture.width)));
    if (!any(beside & (alpha > Lanes(0.0F)))) return;
    const Lanes own = mix(edge.a, edge.b, at.x * Lanes(1 / length));  // affine depth
    const Lanes a = load_at(terms.depth, x, y);
    const Mask behind = is_surface(a) & (a > own);
    if (any(behind)) {
      Lanes left = 0.0F;
      if (!terms.opaque) {
        const Vec3Lanes passes = exp(-load_at(terms.thickness, x, y) * lanes(terms.absorption));
        left = Lanes(0.8F) * dot(passes, Vec3Lanes{0.2126F, 0.7152F, 0.0722F});
      }
      alpha *= select(behind, left, 1.0F);
    }
    if (terms.meshes.exist) {
      alpha = select(load_at(terms.meshes.depth, x, y) > own, 0.0F, alpha);
    }
    const Mask wanted = beside & (alpha > Lanes(0.0F));
    if (!any(wanted)) return;
    blend_over(picture, x, y, {alpha * Vec3Lanes{0.022F, 0.033F, 0.043F}, alpha}, wanted);
  });
}

}  // namespace pbf::PBF_ISA_NAMESPACE
