#include "pbf/render/raster/deep_thickness.hpp"

#include "pbf/core/parallel.hpp"
#include "pbf/render/point_block.hpp"
#include "pbf/render/raster/deep_kernels.hpp"

namespace pbf {
PBF_TABLE_BY_ISA(raster::DeepKernels, deep_kernels, raster::deep_kernels)
}  // namespace pbf

namespace pbf::raster {
namespace {

constexpr int kLevels = DeepKernels::kLevels;
constexpr int kMargin = DeepKernels::kMargin;

/// The sizes of the levels of a picture.
std::vector<Deposit::Size> sizes_of(int width, int height) {
  std::vector<Deposit::Size> sizes;
  for (int level = 0; level <= kLevels; ++level) {
    sizes.push_back(
        {DeepKernels::cells_along(width, level), DeepKernels::cells_along(height, level)});
  }
  return sizes;
}

/// Adds what is between the middles of larger cells to a row of finer ones, whose middles are a
/// quarter of that distance from the nearest.
/// @param row    the number of the finer row, counted as the larger rows are
/// @param first  the number of `to`, even
void add_between(const Real* larger, int pitch, int row, int first, int count, Real* to) {
  const Real* near = larger + static_cast<std::ptrdiff_t>(row / 2) * pitch;
  const Real* far = near + (row % 2 == 0 ? -pitch : pitch);
  const auto at = [&](int k) { return 0.75F * near[k] + 0.25F * far[k]; };
  for (int k = 0; k < count; ++k) {
    const int nearest = (first + k) / 2;
    to[k] += 0.75F * at(nearest) + 0.25F * at(k % 2 == 0 ? nearest - 1 : nearest + 1);
  }
}

}  // namespace

void DeepThickness::find(const PointsView& positions,
                         const std::vector<FullCells::Place>& places,
                         const SplatView& view,
                         int threads) {
  sizes_ = sizes_of(static_cast<int>(view.width), static_cast<int>(view.height));
  const DeepKernels& kernels = deep_kernels(chosen_isa());
  deposit_.add(sizes_, positions.cols(), threads, [&](Index first, Index last, Shares& shares) {
    std::array<std::uint8_t, Shares::kRoom> is_deep{};
    for (Index i = first; i < last; ++i) {
      is_deep[i - first] = places[static_cast<std::size_t>(i)] == FullCells::Place::deep ? 1 : 0;
    }
    kernels.share(point_block(positions, first, last), is_deep.data(), last - first, view, shares);
  });
  // From the coarsest that anything was added to down to cells of two pixels.
  cells_.clear();
  for (int level = kLevels; level > 0; --level) {
    const bool is_used = deposit_.has(level);
    if (!is_used && cells_.empty()) continue;
    const int width = sizes_[level].width, height = sizes_[level].height;
    finer_.assign(static_cast<std::size_t>(width) * height, 0);
    if (is_used) deposit_.add_to(finer_, level, threads);
    if (!cells_.empty()) {
      const int pitch = sizes_[level + 1].width;
      parallel_for(height, threads, [&](Index row) {
        add_between(cells_.data(), pitch, static_cast<int>(row) + kMargin, kMargin, width,
                    finer_.data() + row * width);
      });
    }
    cells_.swap(finer_);
  }
}

void DeepThickness::add_to(Map& thickness, const Tiles& tiles, int threads) const {
  if (cells_.empty()) return;
  const int pitch = sizes_[1].width;
  const std::vector<Tile> list = tiles.list();
  parallel_chunks(std::ssize(list), threads, 1, [&](Index first, Index) {
    const Tile tile = list[static_cast<std::size_t>(first)];
    const int columns = std::min(kTileSide, thickness.width() - tile.x);
    for (int y = tile.y; y < std::min(tile.y + kTileSide, thickness.height()); ++y) {
      add_between(cells_.data(), pitch, y + 2 * kMargin, tile.x + 2 * kMargin, columns,
                  thickness.row(y) + tile.x);
    }
  });
}

}  // namespace pbf::raster
