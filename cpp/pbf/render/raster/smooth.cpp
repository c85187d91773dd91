#include "pbf/render/raster/smooth.hpp"

#include "pbf/core/parallel.hpp"
#include "pbf/render/raster/smooth_loops.hpp"

#include <algorithm>
#include <array>

namespace pbf {

#define PBF_DECLARE(isa)                     \
  namespace isa {                            \
  const raster::SmoothLoops& smooth_loops(); \
  }
PBF_FOR_EACH_ISA(PBF_DECLARE)
#undef PBF_DECLARE

namespace raster {

const SmoothLoops& smooth_loops(Isa isa) {
  using FindTable = const SmoothLoops& (*)();
#define PBF_TABLE(isa) isa::smooth_loops,
  static constexpr FindTable tables[] = {PBF_FOR_EACH_ISA(PBF_TABLE)};
#undef PBF_TABLE
  return tables[static_cast<std::size_t>(isa)]();
}

namespace {

enum class Axis { x, y };
constexpr float kNotThere = -1e30F;  // less than any value of any layer
constexpr Index kTilesAtOnce = 4;

SmoothTerms terms_of(const LayerFilter& filter, const FrameBlock& frame) {
  const auto kind = filter.kind == Smoothing::gaussian       ? SmoothTerms::Kind::gaussian
                    : filter.kind == Smoothing::narrow_range ? SmoothTerms::Kind::narrow_range
                                                             : SmoothTerms::Kind::bilateral;
  return {.kind = kind,
          .thickness = filter.layer == LayerFilter::Layer::thickness,
          .perspective = frame.size[2] > 0.5F,
          .radius = filter.radius * frame.size[3],
          .range = filter.range,
          .behind = filter.behind};
}

/// Copies the tile and what is around it along an axis. In memory of its own the neighbors along a
/// column do not compete for the same few lines of the cache, and nothing ends at the border.
Surroundings surroundings(
    const Map& values, Tile tile, Axis axis, int reach, std::vector<float>& memory) {
  const int extent = axis == Axis::x ? values.width() : values.height();
  reach = std::min(reach, extent);
  const int across = axis == Axis::x ? reach : 0;
  const int along = axis == Axis::y ? reach : 0;
  const int row = kTileSide + 2 * across;
  const int rows = kTileSide + 2 * along;
  memory.resize(static_cast<std::size_t>(row) * rows);
  const int first = std::max(tile.x - across, 0);
  const int last = std::min(tile.x + kTileSide + across, values.width());
  float* to = memory.data();
  for (int y = tile.y - along; y < tile.y + kTileSide + along; ++y, to += row) {
    if (y < 0 || y >= values.height()) {
      std::fill_n(to, row, kNotThere);
      continue;
    }
    float* end = std::fill_n(to, first - (tile.x - across), kNotThere);
    end = std::copy(values.row(y) + first, values.row(y) + last, end);
    std::fill(end, to + row, kNotThere);
  }
  return {.first = memory.data() + along * row + across,
          .row = row,
          .tap = axis == Axis::x ? 1 : row,
          .reach = reach};
}

void smooth_along(Axis axis,
                  const SmoothTerms& terms,
                  const std::vector<Tile>& tiles,
                  const Map& values,
                  const Map& spheres,
                  Map& out,
                  int threads) {
  const SmoothLoops& loops = smooth_loops(chosen_isa());
  parallel_chunks(static_cast<Index>(tiles.size()), threads, kTilesAtOnce,
                  [&](Index first, Index last) {
                    std::array<float, kTileSide * kTileSide> radius;
                    std::vector<float> memory;
                    for (Index k = first; k < last; ++k) {
                      const Tile tile = tiles[static_cast<std::size_t>(k)];
                      const float most = loops.radii(terms, values, spheres, tile, radius.data());
                      // The stride is at most a pixel longer than a tap's share of the radius.
                      const int reach = static_cast<int>(most * (1 + 1.0F / kMostTaps)) + 3;
                      loops.smooth(terms, surroundings(values, tile, axis, reach, memory),
                                   radius.data(), out.row(tile.y) + tile.x, out.pitch());
                    }
                  });
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

}  // namespace raster
}  // namespace pbf
