#include "pbf/render/raster/colored.hpp"

#include "pbf/core/parallel.hpp"
#include "pbf/render/raster/colored_kernels.hpp"
#include "pbf/render/raster/resolve.hpp"
#include "pbf/render/raster/terms.hpp"

namespace pbf {
PBF_TABLE_BY_ISA(raster::ColoredKernels, colored_kernels, raster::colored_kernels)
}  // namespace pbf

namespace pbf::raster {

void ColoredSplats::bin(const PointsView& positions,
                        const Colors& colors,
                        const SplatView& view,
                        int threads) {
  particles_.resize(positions.cols());
  parallel_for(positions.cols(), threads, [&](Index i) {
    const auto x = positions.col(i);
    particles_[i] = {x[0], x[1], x[2], packed_color(colors[static_cast<std::size_t>(i)])};
  });
  splats_.bin(particles_.data(), particles_.size(), view, threads);
}

void ColoredSplats::spheres(const PointsView& positions,
                            const Colors& colors,
                            Real radius,
                            const FrameBlock& frame,
                            SphereMaps& out,
                            int threads) {
  const ColoredKernels& kernels = colored_kernels(chosen_isa());
  const SplatView view = splat_view(frame, {.radius = radius});
  bin(positions, colors, view, threads);
  for (Map* map : {&out.depth, &out.normal.x, &out.normal.y, &out.normal.z, &out.color}) {
    map->begin(tiles());
  }
  splats_.for_tiles(threads, [&](Tile tile, const Record* centers, const Record*, Index count) {
    const std::ptrdiff_t at = tile.y * out.depth.pitch() + tile.x;
    kernels.spheres(
        centers, count, view, tile,
        {.depth = out.depth.row(0) + at,
         .normal = {out.normal.x.row(0) + at, out.normal.y.row(0) + at, out.normal.z.row(0) + at},
         .color = out.color.row(0) + at,
         .pitch = out.depth.pitch()});
  });
}

void ColoredSplats::tint(const PointsView& positions,
                         const Colors& colors,
                         Real radius,
                         const FrameBlock& frame,
                         const Map& surface,
                         TintMaps& out,
                         int threads) {
  const ColoredKernels& kernels = colored_kernels(chosen_isa());
  SplatView view = splat_view(frame, {.radius = radius});
  view.width = static_cast<float>(out.weight.width());
  view.height = static_cast<float>(out.weight.height());
  bin(positions, colors, view, threads);
  for (Map* map : {&out.red, &out.green, &out.blue, &out.weight}) map->begin(tiles());
  const float* light = light_of_srgb();
  splats_.for_tiles(threads, [&](Tile tile, const Record* centers, const Record*, Index count) {
    const std::ptrdiff_t at = tile.y * out.weight.pitch() + tile.x;
    kernels.tint(centers, count, view, texels_of(surface), light, tile,
                 {.light = {out.red.row(0) + at, out.green.row(0) + at, out.blue.row(0) + at},
                  .weight = out.weight.row(0) + at,
                  .pitch = out.weight.pitch()});
  });
}

}  // namespace pbf::raster
