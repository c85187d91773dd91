#include "pbf/render/raster/normal.hpp"

#include "pbf/core/parallel.hpp"
#include "pbf/render/raster/normal_kernels.hpp"
#include "pbf/render/raster/terms.hpp"

namespace pbf {
PBF_TABLE_BY_ISA(raster::NormalKernels, normal_kernels, raster::normal_kernels)
}  // namespace pbf

namespace pbf::raster {

void normal(const Map& depth,
            const Map& spheres,
            const Tiles& tiles,
            const FrameBlock& frame,
            const RenderParams& params,
            NormalMaps& out,
            int threads) {
  const NormalKernels& kernels = normal_kernels(chosen_isa());
  const NormalTerms terms{.frame = frame_terms(frame),
                          .depth = texels_of(depth),
                          .spheres = texels_of(spheres),
                          .range = params.smoothing_range_in_force(),
                          .radius = params.radius,
                          .drop_radius = params.drop_radius_in_force()};
  for (Map* map : {&out.x, &out.y, &out.z}) map->begin(tiles);
  const std::vector<Tile> list = tiles.list();
  parallel_chunks(std::ssize(list), threads, 1, [&](Index first, Index) {
    const Tile tile = list[static_cast<std::size_t>(first)];
    kernels.normal(terms, tile, out.x.row(tile.y) + tile.x, out.y.row(tile.y) + tile.x,
                   out.z.row(tile.y) + tile.x);
  });
}

}  // namespace pbf::raster
