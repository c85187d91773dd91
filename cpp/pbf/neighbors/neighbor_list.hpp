#pragma once

#include "pbf/core/types.hpp"
#include "pbf/neighbors/cell_grid.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace pbf {

/// Rows of different lengths, one per particle, written by several threads at once: every chunk of
/// kChunk particles has a buffer of its own, which keeps its memory from step to step.
template <class T>
class Rows {
 public:
  void resize(Index n) {
    begin_.resize(static_cast<std::size_t>(n));
    end_.resize(static_cast<std::size_t>(n));
    chunks_.resize(static_cast<std::size_t>((n + kChunk - 1) / kChunk));
  }
  [[nodiscard]] Index size() const { return static_cast<Index>(begin_.size()); }
  [[nodiscard]] std::span<const T> operator[](Index i) const {
    const T* data = chunks_[static_cast<std::size_t>(i / kChunk)].data();
    return {data + begin_[static_cast<std::size_t>(i)], data + end_[static_cast<std::size_t>(i)]};
  }
  /// The buffer of the chunk that starts at particle `first`; rows are appended to it in order of
  /// particles.
  std::vector<T>& chunk(Index first) { return chunks_[static_cast<std::size_t>(first / kChunk)]; }
  void set_row(Index i, std::size_t begin, std::size_t end) {
    begin_[static_cast<std::size_t>(i)] = static_cast<std::uint32_t>(begin);
    end_[static_cast<std::size_t>(i)] = static_cast<std::uint32_t>(end);
  }

 private:
  std::vector<std::uint32_t> begin_, end_;
  std::vector<std::vector<T>> chunks_;
};

/// More neighbors than any fluid has: particles piled up in one place, which would cost memory
/// without end.
inline constexpr Index kMostNeighbors = 8192;

/// For each particle the others within h, in ascending order of their places in the sorted arrays.
class NeighborList {
 public:
  /// @param grid  built from the same positions and h
  /// @param x     those positions in the grid's order
  /// Throws SimulationFailed if a particle has more than kMostNeighbors.
  void build(const CellGrid& grid, const PointsView& x, Real h, int threads);

  [[nodiscard]] std::span<const std::uint32_t> operator[](Index i) const { return rows_[i]; }
  [[nodiscard]] Index size() const { return rows_.size(); }

 private:
  Rows<std::uint32_t> rows_;
};

}  // namespace pbf
