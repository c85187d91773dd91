#pragma once

#include "pbf/core/isa.hpp"
#include "pbf/core/parallel.hpp"
#include "pbf/neighbors/scan.hpp"
#include "pbf/render/neighborhoods.hpp"

#include <vector>

namespace pbf {

/// Room for the candidates around a cell.
class CandidateRoom {
 public:
  Candidates candidates(CellGrid::Ranges ranges) {
    std::size_t most = kMostLanes;
    for (const Span& range : ranges) most += range.end - range.begin;
    if (entries_.size() < most) {
      entries_.resize(2 * most);
      numbers_.resize(3 * entries_.size());
    }
    Real* x = numbers_.data();
    return {x, x + entries_.size(), x + 2 * entries_.size(), entries_.data(), 0};
  }

 private:
  std::vector<Real> numbers_;
  std::vector<std::uint32_t> entries_;
};

/// Calls f(k, candidates) for the sorted particles k that wanted(k) picks. Candidates are all
/// that are within the distance of k, itself among them, and others that are farther away.
template <class Wanted, class F>
void for_each_with_candidates(const Neighborhoods& particles, int threads, Wanted&& wanted, F&& f) {
  const Scan& loops = scan(chosen_isa());
  const Record* sorted = particles.sorted().data();
  parallel_chunks(particles.sorted().size(), threads, 4 * kChunk, [&](Index first, Index last) {
    while (first < last && !wanted(static_cast<std::uint32_t>(first))) ++first;
    while (first < last && !wanted(static_cast<std::uint32_t>(last - 1))) --last;
    thread_local CandidateRoom room;
    const auto cell = [&](std::uint32_t begin, std::uint32_t end, CellGrid::Ranges ranges) {
      Candidates candidates{};
      for (std::uint32_t k = begin; k < end; ++k) {
        if (!wanted(k)) continue;
        if (candidates.count == 0) {
          candidates = room.candidates(ranges);
          candidates.count = loops.collect(sorted, ranges.data(), ranges.size(), candidates);
        }
        f(k, candidates);
      }
    };
    particles.grid().for_each_cell(first, last, cell);
  });
}

}  // namespace pbf
