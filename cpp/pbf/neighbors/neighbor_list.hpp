#pragma once

#include "pbf/core/isa.hpp"
#include "pbf/neighbors/cell_grid.hpp"
#include "pbf/neighbors/sliced_rows.hpp"

#include <iterator>

namespace pbf {

/// More neighbors than any fluid has: particles piled up in one place, which would cost memory
/// without end.
inline constexpr Index kMostNeighbors = 8192;

/// For each particle the others within h, in ascending order of their places in the sorted arrays.
class NeighborList {
 public:
  /// @param grid  built from the same positions and h
  /// @param x     those positions in the grid's order; ghosts have no rows
  /// Throws SimulationFailed if a particle has more than kMostNeighbors.
  void build(const CellGrid& grid, const Records& x, Real h, int threads);

  [[nodiscard]] Index size() const { return rows_.size(); }
  /// What it was built with, and is laid out for.
  [[nodiscard]] Isa isa() const { return isa_; }
  [[nodiscard]] int lanes() const { return rows_.lanes(); }
  [[nodiscard]] std::size_t bytes() const { return rows_.bytes(); }
  /// An entry is four times the place of a neighbor: the offset of its record in floats.
  [[nodiscard]] SliceView<std::uint32_t> view(Index first) const { return rows_.view(first); }

  /// The places of i's neighbors: `for (const std::uint32_t j : list[i])`.
  class Row;
  [[nodiscard]] Row operator[](Index i) const;

 private:
  void build_chunk(const CellGrid& grid, const Records& x, Real h, Index first, Index last);

  Isa isa_{};
  std::uint32_t filler_ = 0;
  SlicedRows<std::uint32_t> rows_;
};

class NeighborList::Row {
 public:
  class Iterator {
   public:
    using value_type = std::uint32_t;
    using difference_type = std::ptrdiff_t;
    Iterator() = default;
    Iterator(const std::uint32_t* entry, const Row* row) : entry_(entry), row_(row) {}
    std::uint32_t operator*() const { return *entry_ / 4; }
    Iterator& operator++() {
      entry_ += row_->lanes_;
      return *this;
    }
    Iterator operator++(int) {
      const Iterator before = *this;
      ++*this;
      return before;
    }
    /// Fillers stand at the end.
    bool operator==(std::default_sentinel_t) const {
      return entry_ == row_->end_ || *entry_ == row_->filler_;
    }

   private:
    const std::uint32_t* entry_ = nullptr;
    const Row* row_ = nullptr;
  };
  Row(const std::uint32_t* begin, const std::uint32_t* end, int lanes, std::uint32_t filler)
      : begin_(begin), end_(end), lanes_(lanes), filler_(filler) {}
  [[nodiscard]] Iterator begin() const { return {begin_, this}; }
  [[nodiscard]] static std::default_sentinel_t end() { return {}; }
  [[nodiscard]] Index size() const {
    Index count = 0;
    for (auto entry = begin(); entry != end(); ++entry) ++count;
    return count;
  }

 private:
  const std::uint32_t *begin_, *end_;
  int lanes_;
  std::uint32_t filler_;
};

inline NeighborList::Row NeighborList::operator[](Index i) const {
  const auto slots = rows_.slots(i);
  const auto lanes = static_cast<std::uint32_t>(rows_.lanes());
  const std::uint32_t* lane = rows_.chunk(i).entries.data() + i % rows_.lanes();
  return {lane + slots.begin * lanes, lane + slots.end * lanes, rows_.lanes(), filler_};
}

}  // namespace pbf
