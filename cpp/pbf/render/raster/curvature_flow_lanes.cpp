// Compiled once per instruction set (cpp/pbf_render.cmake). The formulas are those of
// glsl/curvature_flow.frag, where they are explained.
#include "pbf/render/raster/curvature_flow_kernels.hpp"
#include "pbf/render/raster/frame_lanes.hpp"

namespace pbf::PBF_ISA_NAMESPACE {
namespace {

using raster::FlowKernels;
using raster::FlowTerms;
using raster::kTileSide;
using raster::Map;
using raster::Surroundings;
using raster::Tile;

struct Neighbors {
  Lanes next, previous;  // differences to them
  Mask exist;            // both
};

PBF_INLINE Neighbors
to_neighbors(const float* at, std::ptrdiff_t offset, Lanes a, Lanes down, Lanes up) {
  const Lanes zero(0);
  const Lanes d1 = load_lanes(at + offset) - a, d2 = load_lanes(at - offset) - a;
  const Mask exist1 = (-down <= d1) & (d1 <= up), exist2 = (-down <= d2) & (d2 <= up);
  return {select(exist1, d1, select(exist2, -d2, zero)),
          select(exist2, d2, select(exist1, -d1, zero)), exist1 & exist2};
}

PBF_INLINE Lanes numbers_from(float first) {
  Lanes numbers;
  for (int lane = 0; lane < kLanes; ++lane) numbers.v[lane] = first + static_cast<float>(lane);
  return numbers;
}

void stage(const FlowTerms& terms,
           const Surroundings& around,
           const Map& previous,
           const Map& spheres,
           Tile tile,
           Map& out) {
  const Lanes one(1);
  const float far = 0.5F * (terms.stages * terms.stages + terms.stages);
  const Lanes ahead((2 * terms.stage - 1) / terms.stage), back((terms.stage - 1) / terms.stage);
  for (int row = 0; row < kTileSide; ++row) {
    const auto y_pixel = static_cast<float>(tile.y + row) + 0.5F;
    const Lanes ray_y(terms.perspective ? (2 * y_pixel / terms.height - 1) * terms.half_height : 0);
    for (int column = 0; column < kTileSide; column += kLanes) {
      const float* at = around.first + row * around.pitch + column;
      float* to = out.row(tile.y + row) + tile.x + column;
      const Lanes a = load_lanes(at);
      const Mask surface = a > Lanes(kLeastSurface);
      const Lanes down = farther(terms.perspective, a, terms.range);
      const Lanes up = nearer(terms.perspective, a, terms.range);
      const Neighbors x = to_neighbors(at, 1, a, down, up);
      const Neighbors y = to_neighbors(at, around.pitch, a, down, up);
      const Neighbors rising = to_neighbors(at, around.pitch + 1, a, down, up);
      const Neighbors falling = to_neighbors(at, 1 - around.pitch, a, down, up);
      const Mask all_exist = x.exist & y.exist & rising.exist & falling.exist;
      const Lanes a_xx = x.next + x.previous, a_yy = y.next + y.previous;
      const Lanes a_xy =
          select(all_exist,
                 Lanes(0.25F) * (rising.next + rising.previous - falling.next - falling.previous),
                 Lanes(0));

      const Lanes scale_of_slope(0.5F * terms.pixels_per_meter);
      const Lanes g_x = scale_of_slope * (x.next - x.previous);
      const Lanes g_y = scale_of_slope * (y.next - y.previous);
      Lanes ray_x(0), n_z = one;
      if (terms.perspective) {
        const Lanes x_pixel = numbers_from(static_cast<float>(tile.x + column) + 0.5F);
        ray_x = (Lanes(2) * x_pixel / Lanes(terms.width) - one) * Lanes(terms.half_width);
        n_z = a - (ray_x * g_x + ray_y * g_y);
      }
      const Lanes inverse = one / sqrt(g_x * g_x + g_y * g_y + n_z * n_z);
      const Lanes t_x = (g_x - n_z * ray_x) * inverse, t_y = (g_y - n_z * ray_y) * inverse;
      const Lanes m11 = one + ray_x * ray_x - t_x * t_x;
      const Lanes m12 = ray_x * ray_y - t_x * t_y;
      const Lanes m22 = one + ray_y * ray_y - t_y * t_y;

      Lanes scale = smoothing_share(load_lanes(spheres.row(tile.y + row) + tile.x + column)) *
                    Lanes(terms.pixels_per_meter);
      if (terms.perspective) scale *= a;
      const Lanes time =
          min(Lanes(terms.variance) * scale * scale, Lanes(0.45F * far) / (m11 + m22));
      const Lanes flow = time / Lanes(far) * (m11 * a_xx + Lanes(2) * m12 * a_xy + m22 * a_yy);
      const Lanes before = load_lanes(previous.row(tile.y + row) + tile.x + column);
      store(to, select(surface, ahead * (a + flow) - back * before, a));
    }
  }
}

}  // namespace

const FlowKernels& flow_kernels() {
  static constexpr FlowKernels kernels{stage};
  return kernels;
}

}  // namespace pbf::PBF_ISA_NAMESPACE
