#include "pbf/neighbors/neighbor_list.hpp"

#include "pbf/core/error.hpp"
#include "pbf/core/parallel.hpp"

#include <string>

namespace pbf {

void NeighborList::build(const CellGrid& grid, const PointsView& x, Real h, int threads) {
  rows_.resize(x.cols());
  const Real h2 = h * h;
  parallel_chunks(x.cols(), threads, kChunk, [&](Index first, Index last) {
    auto& list = rows_.chunk(first);
    std::size_t size = 0;
    grid.for_each_cell(first, last, [&](Index begin, Index end, const CellGrid::Ranges& ranges) {
      std::size_t candidates = 0;
      for (const auto& range : ranges) candidates += range.end - range.begin;
      for (Index i = begin; i < end; ++i) {
        // Room for every candidate, so that the loop writes without asking: a miss is overwritten
        // by the next.
        if (list.size() < size + candidates) list.resize(2 * (size + candidates));
        const std::size_t row = size;
        const Real xi = x(0, i), yi = x(1, i), zi = x(2, i);
        for (const auto& range : ranges) {
          for (std::uint32_t j = range.begin; j < range.end; ++j) {
            const Real dx = xi - x(0, j), dy = yi - x(1, j), dz = zi - x(2, j);
            list[size] = j;
            size += static_cast<std::size_t>(dx * dx + dy * dy + dz * dz < h2 && j != i);
          }
        }
        if (size - row > kMostNeighbors) {
          throw SimulationFailed(
              "neighbors: a particle at (" + std::to_string(xi) + ", " + std::to_string(yi) + ", " +
              std::to_string(zi) + ") m has " + std::to_string(size - row) +
              " others within the support radius (" + std::to_string(h) + " m), more than " +
              std::to_string(kMostNeighbors) +
              "; particles are piled up: check the spacing against the positions");
        }
        rows_.set_row(i, row, size);
      }
    });
  });
}

}  // namespace pbf
