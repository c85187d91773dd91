#include "pbf/render/raster/smooth.hpp"

#include "pbf/core/parallel.hpp"
#include "pbf/render/raster/smooth_kernels.hpp"

#include <array>

namespace pbf {
PBF_TABLE_BY_ISA(raster::SmoothKernels, smooth_kernels, raster::smooth_kernels)
}  // namespace pbf

namespace pbf::raster {
namespace {

enum class Axis { x, y };
constexpr Index kTilesAtOnce = 4;

SmoothTerms terms_of(const LayerFilter& filter, const FrameBlock& frame) {
  const bool far_side = filter.layer == LayerFilter::Layer::far_side;
  const auto kind = far_side                                 ? SmoothTerms::Kind::far_side
                    : filter.kind == Smoothing::gaussian     ? SmoothTerms::Kind::gaussian
                    : filter.kind == Smoothing::narrow_range ? SmoothTerms::Kind::narrow_range
                                                             : SmoothTerms::Kind::bilateral;
  return {.kind = kind,
          .thickness = filter.layer == LayerFilter::Layer::thickness,
          .perspective = frame.size[2] > 0.5F,
          .close_gaps = filter.close_gaps,
          .most_taps = kMostTaps,
          .radius = filter.radius * frame.size[3],
          .range = filter.range,
          .behind = filter.behind};
}

void smooth_along(Axis axis,
                  const SmoothTerms& terms,
                  const std::vector<Tile>& tiles,
                  const Map& values,
                  const Map& spheres,
                  Map& out,
                  int threads) {
  const SmoothKernels& kernels = smooth_kernels(chosen_isa());
  const auto smooth_tiles = [&](Index first, Index last) {
    std::array<float, kTileSide * kTileSide> radius;
    std::vector<float> memory;
    for (Index k = first; k < last; ++k) {
      const Tile tile = tiles[static_cast<std::size_t>(k)];
      const float most = kernels.radii(terms, values, spheres, tile, radius.data());
      // Taps are a whole number of pixels apart, so the last may lie a bit farther than the radius.
      const int reach = static_cast<int>(most * (1 + 1.0F / kMostTaps)) + 3;
      const Surroundings around = surroundings(values, tile, axis == Axis::x ? reach : 0,
                                               axis == Axis::y ? reach : 0, memory);
      kernels.smooth(terms, around, radius.data(), spheres.row(tile.y) + tile.x,
                     out.row(tile.y) + tile.x, out.pitch());
    }
  };
  parallel_chunks(static_cast<Index>(tiles.size()), threads, kTilesAtOnce, smooth_tiles);
}

}  // namespace

void smooth(const LayerFilter& filter,
            const FrameBlock& frame,
            const Tiles& tiles,
            const Map& values,
            const Map& spheres,
            Map& between,
            Map& out,
            int threads) {
  const SmoothTerms terms = terms_of(filter, frame);
  const std::vector<Tile> list = tiles.list();
  between.begin(tiles);
  smooth_along(Axis::x, terms, list, values, spheres, between, threads);
  out.begin(tiles);
  smooth_along(Axis::y, terms, list, between, spheres, out, threads);
}

}  // namespace pbf::raster
