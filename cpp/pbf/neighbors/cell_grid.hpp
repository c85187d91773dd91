#pragma once

#include "pbf/core/records.hpp"
#include "pbf/core/types.hpp"
#include "pbf/neighbors/scan.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace pbf {

/// Farthest that a particle may be from the origin, in cells: float32 still tells its neighbors
/// apart there.
inline constexpr double kFarthestCell = 1 << 20;

/// Most particles: neighbor lists count the floats of their records in 32 bits.
inline constexpr Index kMostParticles = (Index{1} << 30) - 2 * kMostLanes;

/// Sorts particles into cubic cells and keeps only the cells that hold some, in the order of their
/// keys. Memory and time follow the number of particles, however far they are spread.
class CellGrid {
 public:
  /// Whether a coordinate can be sorted: finite and within kFarthestCell cells. The rule in words.
  static bool reaches(const Vec3& x, Real h);
  static std::string reach_text(Real h);

  /// Finds the order of x by cell; equal cells keep the order they came in. Cells are a hair larger
  /// than h, so that rounding cannot put two particles closer than h two cells apart. Throws
  /// SimulationFailed if a coordinate is not finite or beyond kFarthestCell cells.
  void build(const Records& x, Real h, int threads) { build(x, x.size(), h, threads); }
  /// The same if only so many of x are particles and the rest ghosts, which are neighbors but have
  /// none: in the order they follow behind all particles, by cell as well. Along one axis at least
  /// all must lie within kFarthestCell cells, or there would be more keys than 64 bits tell apart.
  void build(const Records& x, Index particles, Real h, int threads);

  [[nodiscard]] Index particles() const { return particles_; }
  /// Place in cell order → index in the x that was given.
  [[nodiscard]] const std::vector<std::uint32_t>& order() const { return order_; }

  [[nodiscard]] std::size_t bytes() const {
    return (entries_.capacity() + scratch_.capacity()) * sizeof(Entry) +
           (order_.capacity() + starts_.capacity()) * sizeof(std::uint32_t) +
           keys_.capacity() * sizeof(std::uint64_t);
  }

  /// Walks the cells that hold the particles [first, last) of the sorted order, calling
  /// f(begin, end, ranges): the cell's particles, clipped to [first, last), and the nine ranges of
  /// sorted particles (three cells in x each) that hold all their neighbors; where there are ghosts
  /// nine more of these.
  using Ranges = std::span<const Span>;
  template <class F>
  void for_each_cell(Index first, Index last, F&& f) const;

 private:
  struct Entry {
    std::uint64_t key;
    std::uint32_t particle;
  };
  void sort_entries(std::uint64_t largest_key, int threads);
  void find_cells(int threads);

  std::vector<Entry> entries_, scratch_;
  std::vector<std::uint32_t> order_;
  std::vector<std::uint64_t> keys_;    // of the cells that hold particles, ascending
  std::vector<std::uint32_t> starts_;  // first sorted particle of each, and the end
  std::uint64_t stride_y_ = 1, stride_z_ = 1;
  Index particles_ = 0;
  std::uint64_t ghost_keys_ = 0;  // a ghost's key is larger by this than a particle's beside it
};

template <class F>
void CellGrid::for_each_cell(Index first, Index last, F&& f) const {
  if (first >= last) return;
  const auto cell_of_first =
      std::upper_bound(starts_.begin(), starts_.end(), static_cast<std::uint32_t>(first));
  auto cell = static_cast<std::size_t>(cell_of_first - starts_.begin()) - 1;

  // A cell's neighbors lie in nine rows; in each, the cells x−1, x, x+1 have consecutive keys and
  // so their particles lie in one range. As the cell's key grows so do the rows', so nine cursors
  // only move forward. Ghosts have nine more.
  const int rows = ghost_keys_ > 0 ? 18 : 9;
  std::array<std::int64_t, 18> row_offset{};
  std::array<std::size_t, 18> low{}, high{};
  std::array<Span, 18> ranges;
  for (int k = 0; k < rows; ++k) {
    row_offset[k] = (k % 9 / 3 - 1) * static_cast<std::int64_t>(stride_z_) +
                    (k % 3 - 1) * static_cast<std::int64_t>(stride_y_) +
                    (k < 9 ? 0 : static_cast<std::int64_t>(ghost_keys_));
    const auto row = keys_[cell] + row_offset[k];
    low[k] = static_cast<std::size_t>(std::lower_bound(keys_.begin(), keys_.end(), row - 1) -
                                      keys_.begin());
    high[k] = low[k];
  }
  for (; cell < keys_.size() && starts_[cell] < last; ++cell) {
    for (int k = 0; k < rows; ++k) {
      const auto row = keys_[cell] + row_offset[k];
      while (low[k] < keys_.size() && keys_[low[k]] < row - 1) ++low[k];
      high[k] = std::max(high[k], low[k]);
      while (high[k] < keys_.size() && keys_[high[k]] <= row + 1) ++high[k];
      ranges[k] = {starts_[low[k]], starts_[high[k]]};
    }
    f(std::max(starts_[cell], static_cast<std::uint32_t>(first)),
      std::min(starts_[cell + 1], static_cast<std::uint32_t>(last)),
      Ranges(ranges).first(static_cast<std::size_t>(rows)));
  }
}

}  // namespace pbf
