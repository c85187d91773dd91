#include "pbf/neighbors/neighbor_list.hpp"

#include "pbf/core/error.hpp"
#include "pbf/core/parallel.hpp"
#include "pbf/neighbors/scan.hpp"

#include <string>

namespace pbf {
namespace {

/// Particles of a cell that are searched at a time: bounds the memory that a heap can take before
/// it is found out.
constexpr std::uint32_t kBatch = 16;

/// What a thread needs to search a chunk.
struct Scratch {
  std::vector<Real> coordinates;
  std::vector<std::uint32_t> entries;
  std::vector<std::uint32_t> rows;
  std::array<std::uint32_t, static_cast<std::size_t>(kChunk)> offsets, lengths;

  Candidates candidates(std::size_t count) {
    const std::size_t room = count + static_cast<std::size_t>(kMostLanes);
    if (entries.size() < room) {
      entries.resize(2 * room);
      coordinates.resize(3 * entries.size());
    }
    Real* x = coordinates.data();
    return {x, x + entries.size(), x + 2 * entries.size(), entries.data(), 0};
  }
};

[[noreturn]] void fail_piled_up(const Record& x, std::uint32_t neighbors, Real h) {
  throw SimulationFailed("neighbors: a particle at (" + std::to_string(x.x) + ", " +
                         std::to_string(x.y) + ", " + std::to_string(x.z) + ") m has " +
                         std::to_string(neighbors) + " others within the support radius (" +
                         std::to_string(h) + " m), more than " + std::to_string(kMostNeighbors) +
                         "; particles are piled up: check the spacing against the positions");
}

}  // namespace

void NeighborList::build(const CellGrid& grid, const Records& x, Real h, int threads) {
  isa_ = chosen_isa();
  filler_ = 4 * static_cast<std::uint32_t>(Records::filler(x.size()));
  rows_.resize(grid.particles(), scan(isa_).lanes);
  parallel_chunks(grid.particles(), threads, kChunk,
                  [&](Index first, Index last) { build_chunk(grid, x, h, first, last); });
}

void NeighborList::build_chunk(
    const CellGrid& grid, const Records& x, Real h, Index first, Index last) {
  const Scan& loops = scan(isa_);
  thread_local Scratch scratch;
  std::size_t size = 0;  // of scratch.rows in use
  grid.for_each_cell(
      first, last, [&](std::uint32_t begin, std::uint32_t end, CellGrid::Ranges ranges) {
        std::size_t count = 0;
        for (const Span& range : ranges) count += range.end - range.begin;
        Candidates candidates = scratch.candidates(count);
        candidates.count = loops.collect(x.data(), ranges.data(), ranges.size(), candidates);
        // The cell's own row is the fifth.
        std::uint32_t self = begin - ranges[4].begin;
        for (int k = 0; k < 4; ++k) self += ranges[k].end - ranges[k].begin;

        for (std::uint32_t b = begin; b < end; b += kBatch, self += kBatch) {
          const std::uint32_t e = std::min(end, b + kBatch);
          const std::size_t room = size + (e - b) * (count + kMostLanes + 8);
          if (scratch.rows.size() < room) scratch.rows.resize(2 * room);
          std::uint32_t* const out = scratch.rows.data() + size;
          std::uint32_t* const lengths = scratch.lengths.data() + (b - first);
          const std::uint32_t* const done =
              loops.rows(x.data(), b, e, candidates, self, h * h, filler_, out, lengths);
          std::size_t offset = size;
          for (std::uint32_t i = b; i < e; ++i) {
            const std::uint32_t length = lengths[i - b];
            if (length > kMostNeighbors) fail_piled_up(x[i], length, h);
            scratch.offsets[i - first] = static_cast<std::uint32_t>(offset);
            offset += (length + 3) / 4 * 4;
          }
          size += static_cast<std::size_t>(done - out);
        }
      });

  // Rows side by side, slice by slice.
  const auto count = static_cast<std::size_t>(last - first);
  const std::uint32_t slots = rows_.lay_out(first, std::span(scratch.lengths).first(count));
  const auto lanes = static_cast<Index>(loops.lanes);
  std::uint32_t* out = rows_.chunk(first).reserve(static_cast<std::size_t>((slots + 3) * lanes));
  for (Index slice = 0; slice < last - first; slice += lanes) {
    std::array<const std::uint32_t*, static_cast<std::size_t>(kMostLanes)> rows;
    std::array<std::uint32_t, static_cast<std::size_t>(kMostLanes)> lengths;
    for (Index lane = 0; lane < lanes; ++lane) {
      const bool exists = slice + lane < last - first;
      const auto i = static_cast<std::size_t>(exists ? slice + lane : 0);
      rows[static_cast<std::size_t>(lane)] = scratch.rows.data() + scratch.offsets[i];
      lengths[static_cast<std::size_t>(lane)] = exists ? scratch.lengths[i] : 0;
    }
    const auto [begin, end] = rows_.slots(first + slice);
    loops.pack(rows.data(), lengths.data(), end - begin, filler_, out);
    out += static_cast<Index>(end - begin) * lanes;
  }
}

}  // namespace pbf
