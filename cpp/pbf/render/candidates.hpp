#pragma once

#include "pbf/core/isa.hpp"
#include "pbf/neighbors/cell_grid.hpp"
#include "pbf/neighbors/scan.hpp"

#include <vector>

namespace pbf {

/// Room for the candidates around a cell, and for a number of each.
class CandidateRoom {
 public:
  Candidates candidates(CellGrid::Ranges ranges) {
    std::size_t most = kMostLanes;
    for (const Span& range : ranges) most += range.end - range.begin;
    if (entries_.size() < most) {
      entries_.resize(2 * most);
      numbers_.resize(4 * entries_.size());
    }
    Real* x = numbers_.data();
    return {x, x + entries_.size(), x + 2 * entries_.size(), entries_.data(), 0};
  }
  Real* numbers() { return numbers_.data() + 3 * entries_.size(); }

 private:
  std::vector<Real> numbers_;
  std::vector<std::uint32_t> entries_;
};

/// Calls f(k, candidates) for the particles k in [first, last) that wanted(k) picks, with all that
/// are in their cell or the 26 around it.
/// @param sorted  positions in the order of the grid
template <class Wanted, class F>
void for_each_with_candidates(const CellGrid& grid,
                              const Records& sorted,
                              Index first,
                              Index last,
                              CandidateRoom& room,
                              Wanted&& wanted,
                              F&& f) {
  const Scan& loops = scan(chosen_isa());
  grid.for_each_cell(
      first, last, [&](std::uint32_t begin, std::uint32_t end, CellGrid::Ranges ranges) {
        Candidates candidates{};
        for (std::uint32_t k = begin; k < end; ++k) {
          if (!wanted(k)) continue;
          if (candidates.count == 0) {
            candidates = room.candidates(ranges);
            candidates.count =
                loops.collect(sorted.data(), ranges.data(), ranges.size(), candidates);
          }
          f(k, candidates);
        }
      });
}

}  // namespace pbf
