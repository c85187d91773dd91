#include "pbf/render/raster/curvature_flow.hpp"

#include "pbf/core/parallel.hpp"
#include "pbf/render/raster/curvature_flow_kernels.hpp"

namespace pbf {
PBF_TABLE_BY_ISA(raster::FlowKernels, flow_kernels, raster::flow_kernels)
}  // namespace pbf

namespace pbf::raster {

void curvature_flow(const LayerFilter& filter,
                    const FlowSchedule& schedule,
                    const FrameBlock& frame,
                    const Tiles& tiles,
                    const Map& depth,
                    const Map& spheres,
                    const std::array<Map*, 3>& maps,
                    int threads) {
  const FlowKernels& kernels = flow_kernels(chosen_isa());
  FlowTerms terms{.perspective = frame.size[2] > 0.5F,
                  .width = frame.size[0],
                  .height = frame.size[1],
                  .half_width = frame.lens[0],
                  .half_height = frame.lens[1],
                  .pixels_per_meter = frame.size[3],
                  .range = filter.range,
                  .variance = schedule.variance,
                  .stage = 0,
                  .stages = static_cast<float>(schedule.stages)};
  const std::vector<Tile> list = tiles.list();
  const Map* last = &depth;
  const Map* before = &depth;
  for (int k = schedule.steps * schedule.stages - 1; k >= 0; --k) {
    terms.stage = static_cast<float>(schedule.stages - k % schedule.stages);
    if (terms.stage == 1) before = last;  // a step begins
    Map& out = *maps[static_cast<std::size_t>(k % 3)];
    out.begin(tiles);
    const auto flow_tiles = [&](Index first, Index end) {
      std::vector<float> memory;
      for (Index i = first; i < end; ++i) {
        const Tile tile = list[static_cast<std::size_t>(i)];
        kernels.stage(terms, surroundings(*last, tile, 1, 1, memory), *before, spheres, tile, out);
      }
    };
    parallel_chunks(static_cast<Index>(list.size()), threads, 8, flow_tiles);
    before = last;
    last = &out;
  }
}

}  // namespace pbf::raster
