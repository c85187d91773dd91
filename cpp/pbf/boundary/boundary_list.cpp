#include "pbf/boundary/boundary_list.hpp"

#include "pbf/core/parallel.hpp"

namespace pbf {

void BoundaryList::build(const std::optional<WallLattice>& walls,
                         const Records& x,
                         Index particles,
                         int lanes,
                         int threads) {
  rows_.resize(particles, lanes);
  parallel_chunks(particles, threads, kChunk, [&](Index first, Index last) {
    rows_.chunk(first).ends.fill(0);
    if (walls) build_chunk(*walls, x, first, last);
  });
}

void BoundaryList::build_chunk(const WallLattice& walls,
                               const Records& x,
                               Index first,
                               Index last) {
  thread_local std::vector<Vec3> sites;  // row after row
  std::array<std::uint32_t, static_cast<std::size_t>(kChunk)> lengths;
  std::size_t end = 0;
  for (Index i = first; i < last; ++i) {
    if (sites.size() < end + walls.most_near()) sites.resize(2 * (end + walls.most_near()));
    Vec3* const row = sites.data() + end;
    const Vec3* const row_end = walls.collect_near({x[i].x, x[i].y, x[i].z}, row);
    const auto length = static_cast<std::size_t>(row_end - row);
    lengths[static_cast<std::size_t>(i - first)] = static_cast<std::uint32_t>(length);
    end += length;
  }
  const Index lanes = rows_.lanes();
  const auto count = static_cast<std::size_t>(last - first);
  const Index slots = rows_.lay_out(first, std::span(lengths).first(count));
  Real* const out = rows_.chunk(first).reserve(static_cast<std::size_t>(3 * slots * lanes));
  std::fill(out, out + 3 * slots * lanes, Records::kFar);
  const Vec3* q = sites.data();
  for (Index i = first; i < last; ++i) {
    Real* at = out + 3 * lanes * Index{rows_.slots(i).begin} + i % lanes;
    for (std::uint32_t k = 0; k < lengths[static_cast<std::size_t>(i - first)]; ++k, ++q) {
      at[0] = (*q)[0];
      at[lanes] = (*q)[1];
      at[2 * lanes] = (*q)[2];
      at += 3 * lanes;
    }
  }
}

std::vector<Vec3> BoundaryList::operator[](Index i) const {
  const int lanes = rows_.lanes();
  const auto slots = rows_.slots(i);
  std::vector<Vec3> row;
  for (std::uint32_t slot = slots.begin; slot < slots.end; ++slot) {
    const Real* at =
        rows_.chunk(i).entries.data() + static_cast<Index>(slot) * 3 * lanes + i % lanes;
    if (at[0] == Records::kFar) break;
    row.emplace_back(at[0], at[lanes], at[2 * lanes]);
  }
  return row;
}

}  // namespace pbf
