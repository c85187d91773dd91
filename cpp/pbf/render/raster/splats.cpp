#include "pbf/render/raster/splats.hpp"

#include "pbf/core/parallel.hpp"

#include <algorithm>

namespace pbf::raster {
namespace {

/// Particles that are sorted at a time.
constexpr Index kBlock = 1 << 14;

/// Sprites that cover more tiles are not sorted: their copies would fill the memory.
constexpr int kMostTiles = 64;

bool is_large(const TileBox& box) {
  return (box.last_column - box.first_column + 1) * (box.last_row - box.first_row + 1) > kMostTiles;
}

}  // namespace

SplatView splat_view(const FrameBlock& frame, const RenderParams& params) {
  SplatView view{.view = {},
                 .half_width = frame.lens[0],
                 .half_height = frame.lens[1],
                 .near = frame.lens[2],
                 .far = frame.lens[3],
                 .width = frame.size[0],
                 .height = frame.size[1],
                 .perspective = frame.size[2] > 0.5F,
                 .radius = params.radius,
                 .drop_radius = params.drop_radius_in_force(),
                 .volume = params.volume_in_force()};
  std::copy(frame.view.begin(), frame.view.end(), view.view);
  return view;
}

void Splats::bin(const Records& particles, const SplatView& view, int threads) {
  const SplatKernels& kernels = splat_kernels(chosen_isa());
  tiles_ = Tiles(static_cast<int>(view.width), static_cast<int>(view.height));
  const auto tiles = static_cast<std::size_t>(tiles_.columns()) * tiles_.rows();
  const Index n = particles.size();
  const auto blocks = static_cast<std::size_t>((n + kBlock - 1) / kBlock);
  centers_.resize(n);
  boxes_.resize(static_cast<std::size_t>(n + kMostLanes));
  places_.assign(blocks * tiles, 0);
  const auto for_tiles = [&](Index i, auto&& f) {
    const TileBox& box = boxes_[static_cast<std::size_t>(i)];
    if (is_large(box)) return;
    for (int row = box.first_row; row <= box.last_row; ++row) {
      for (int column = box.first_column; column <= box.last_column; ++column) {
        f(static_cast<std::size_t>(row) * tiles_.columns() + column);
      }
    }
  };
  parallel_chunks(n, threads, kBlock, [&](Index first, Index last) {
    kernels.project(particles.data(), first, last, view, centers_.data(), boxes_.data());
    std::uint32_t* count = places_.data() + static_cast<std::size_t>(first / kBlock) * tiles;
    for (Index i = first; i < last; ++i) for_tiles(i, [&](std::size_t tile) { ++count[tile]; });
  });
  starts_.resize(tiles + 1);
  std::uint32_t sum = 0;
  for (std::size_t tile = 0; tile < tiles; ++tile) {
    starts_[tile] = sum;
    for (std::size_t block = 0; block < blocks; ++block) {
      sum += std::exchange(places_[block * tiles + tile], sum);
    }
    if (sum > starts_[tile]) {
      tiles_.mark(static_cast<int>(tile) % tiles_.columns(),
                  static_cast<int>(tile) / tiles_.columns());
    }
  }
  starts_[tiles] = sum;
  binned_.resize(sum);
  parallel_chunks(n, threads, kBlock, [&](Index first, Index last) {
    std::uint32_t* place = places_.data() + static_cast<std::size_t>(first / kBlock) * tiles;
    for (Index i = first; i < last; ++i) {
      for_tiles(i, [&](std::size_t tile) { binned_[place[tile]++] = centers_[i]; });
    }
  });
}

void Splats::draw(const SplatView& view, Map& depth, Map& thickness, int threads) const {
  const SplatKernels& kernels = splat_kernels(chosen_isa());
  depth.begin(tiles_);
  thickness.begin(tiles_);
  const std::vector<Tile> tiles = tiles_.list();
  parallel_chunks(static_cast<Index>(tiles.size()), threads, 1, [&](Index first, Index) {
    const Tile tile = tiles[static_cast<std::size_t>(first)];
    const int number = tile.y / kTileSide * tiles_.columns() + tile.x / kTileSide;
    const std::uint32_t start = starts_[static_cast<std::size_t>(number)];
    const std::uint32_t end = starts_[static_cast<std::size_t>(number) + 1];
    kernels.draw(binned_.data() + start, end - start, view, tile, depth.row(tile.y) + tile.x,
                 thickness.row(tile.y) + tile.x, depth.pitch());
  });
}

}  // namespace pbf::raster
