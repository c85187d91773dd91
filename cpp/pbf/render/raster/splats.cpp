#include "pbf/render/raster/splats.hpp"

#include "pbf/core/parallel.hpp"
#include "pbf/render/raster/terms.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <utility>

namespace pbf {
PBF_TABLE_BY_ISA(raster::SplatKernels, splat_kernels, raster::splat_kernels)
}  // namespace pbf

namespace pbf::raster {
namespace {

/// Particles that are sorted at a time.
constexpr Index kBlock = 1 << 14;

/// Sprites that cover more tiles are not sorted, but drawn in all: their copies would fill the
/// memory.
constexpr int kMostTiles = 64;

bool is_large(const TileBox& box) {
  return (box.last_column - box.first_column + 1) * (box.last_row - box.first_row + 1) > kMostTiles;
}

void mark(const TileBox& box, Tiles& tiles) {
  for (int row = box.first_row; row <= box.last_row; ++row) {
    for (int column = box.first_column; column <= box.last_column; ++column) {
      tiles.mark(column, row);
    }
  }
}

/// Particles whose tiles are marked at a time.
constexpr Index kMostMarked = 1 << 10;

}  // namespace

SplatView splat_view(const FrameBlock& frame, const RenderParams& params) {
  return {frame_terms(frame), params.radius, params.drop_radius_in_force(),
          params.volume_in_force()};
}

void mark_tiles(const PointsView& positions, Real radius, const FrameBlock& frame, Tiles& tiles) {
  const SplatKernels& kernels = splat_kernels(chosen_isa());
  const SplatView view = splat_view(frame, {.radius = radius});
  parallel_chunks(positions.cols(), 0, kMostMarked, [&](Index first, Index last) {
    const Index count = last - first;
    std::array<Record, kMostMarked + kMostLanes> centers;
    std::array<TileBox, kMostMarked + kMostLanes> boxes;
    for (Index i = 0; i < count; ++i) {
      const auto x = positions.col(first + i);
      centers[i] = {x[0], x[1], x[2], 1};
    }
    kernels.project(centers.data(), nullptr, 0, count, view, centers.data(), boxes.data());
    for (Index i = 0; i < count; ++i) mark(boxes[i], tiles);
  });
}

void mark_tiles(
    const Records& centers, Records stretches, Real radius, const FrameBlock& frame, Tiles& tiles) {
  const SplatKernels& kernels = splat_kernels(chosen_isa());
  const SplatView view = splat_view(frame, {.radius = radius});
  parallel_chunks(centers.size(), 0, kMostMarked, [&](Index first, Index last) {
    std::array<Record, kMostMarked + kMostLanes> projected;
    std::array<TileBox, kMostMarked + kMostLanes> boxes;
    kernels.project(centers.data() + first, stretches.data() + 2 * first, 0, last - first, view,
                    projected.data(), boxes.data());
    for (Index i = 0; i < last - first; ++i) mark(boxes[i], tiles);
  });
}

void Splats::Sprites::resize(Index n, bool stretched) {
  centers.resize(n);
  stretches.resize(stretched ? 2 * (n + kMostLanes) : 0);  // loops read whole vectors
}

void Splats::Sprites::set(Index at, const Sprites& from, Index i) {
  centers[at] = from.centers[i];
  if (stretches.size() == 0) return;
  stretches[2 * at] = from.stretches[2 * i];
  stretches[2 * at + 1] = from.stretches[2 * i + 1];
}

void Splats::bin(
    const Record* particles, Index n, const SplatView& view, int threads, const Record* stretches) {
  const SplatKernels& kernels = splat_kernels(chosen_isa());
  tiles_ = Tiles(static_cast<int>(std::ceil(view.width)), static_cast<int>(std::ceil(view.height)));
  const auto tiles = static_cast<std::size_t>(tiles_.columns()) * tiles_.rows();
  const auto blocks = static_cast<std::size_t>((n + kBlock - 1) / kBlock);
  const bool stretched = stretches != nullptr;
  all_.resize(n, stretched);
  if (stretched) std::copy_n(stretches, 2 * n, all_.stretches.data());
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
  std::atomic<bool> has_large{false};
  parallel_chunks(n, threads, kBlock, [&](Index first, Index last) {
    kernels.project(particles, stretched ? all_.stretches.data() : nullptr, first, last, view,
                    all_.centers.data(), boxes_.data());
    std::uint32_t* count = places_.data() + static_cast<std::size_t>(first / kBlock) * tiles;
    for (Index i = first; i < last; ++i) for_tiles(i, [&](std::size_t tile) { ++count[tile]; });
    if (std::any_of(boxes_.begin() + first, boxes_.begin() + last, is_large)) has_large = true;
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
  large_.clear();
  if (has_large) find_large();
  binned_.resize(sum, stretched);
  parallel_chunks(n, threads, kBlock, [&](Index first, Index last) {
    std::uint32_t* place = places_.data() + static_cast<std::size_t>(first / kBlock) * tiles;
    for (Index i = first; i < last; ++i) {
      for_tiles(i, [&](std::size_t tile) { binned_.set(place[tile]++, all_, i); });
    }
  });
}

void Splats::find_large() {
  TileBox all{std::numeric_limits<std::int16_t>::max(), -1,
              std::numeric_limits<std::int16_t>::max(), -1};
  for (Index i = 0; i < all_.centers.size(); ++i) {
    const TileBox& box = boxes_[static_cast<std::size_t>(i)];
    if (!is_large(box)) continue;
    large_.push_back(i);
    all = {std::min(all.first_column, box.first_column), std::max(all.last_column, box.last_column),
           std::min(all.first_row, box.first_row), std::max(all.last_row, box.last_row)};
  }
  mark(all, tiles_);
}

Splats::Sprites Splats::with_large(Index first, Index count) const {
  const auto large = static_cast<Index>(large_.size());
  Sprites together;
  together.resize(large + count, all_.stretches.size() > 0);
  for (Index k = 0; k < large; ++k) together.set(k, all_, large_[static_cast<std::size_t>(k)]);
  for (Index k = 0; k < count; ++k) together.set(large + k, binned_, first + k);
  return together;
}

void Splats::for_tiles(int threads, const std::function<TileLoop>& f) const {
  const std::vector<Tile> tiles = tiles_.list();
  parallel_chunks(static_cast<Index>(tiles.size()), threads, 1, [&](Index first, Index) {
    const Tile tile = tiles[static_cast<std::size_t>(first)];
    const auto number = static_cast<std::size_t>(tile.y / kTileSide * tiles_.columns()) +
                        static_cast<std::size_t>(tile.x / kTileSide);
    const auto own = static_cast<Index>(starts_[number]);
    const auto count = static_cast<Index>(starts_[number + 1]) - own;
    if (large_.empty()) {
      f(tile, binned_.centers.data() + own, binned_.stretches_from(own), count);
      return;
    }
    const Sprites together = with_large(own, count);
    f(tile, together.centers.data(), together.stretches_from(0), together.centers.size());
  });
}

void Splats::draw(const SplatView& view, Map& depth, Map& thickness, Map& back, int threads) const {
  const SplatKernels& kernels = splat_kernels(chosen_isa());
  depth.begin(tiles_);
  thickness.begin(tiles_);
  back.begin(tiles_);
  for_tiles(threads, [&](Tile tile, const Record* centers, const Record* stretches, Index count) {
    const std::ptrdiff_t at = tile.y * thickness.pitch() + tile.x;
    kernels.draw(centers, stretches, count, view, tile, depth.row(0) + at, thickness.row(0) + at,
                 back.row(0) + at, thickness.pitch());
  });
}

}  // namespace pbf::raster
