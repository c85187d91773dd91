#include "pbf/boundary/boundary_list.hpp"

#include "pbf/core/parallel.hpp"

namespace pbf {

void BoundaryList::build(const std::optional<WallLattice>& walls,
                         const Records& x,
                         int lanes,
                         int threads) {
  rows_.resize(x.size(), lanes);
  parallel_chunks(x.size(), threads, kChunk, [&](Index first, Index last) {
    rows_.chunk(first).ends.fill(0);
    if (walls) build_chunk(*walls, x, first, last);
  });
}

void BoundaryList::build_chunk(const WallLattice& walls,
                               const Records& x,
                               Index first,
                               Index last) {
  thread_local std::vector<Vec3> sites;  // row after row
  std::array<std::uint32_t, static_cast<std::size_t>(kChunk + kMostLanes + 1)> begins{};
  sites.clear();
  for (Index i = first; i < last; ++i) {
    walls.for_each_near({x[i].x, x[i].y, x[i].z}, [&](const Vec3& q) { sites.push_back(q); });
    begins[static_cast<std::size_t>(i - first + 1)] = static_cast<std::uint32_t>(sites.size());
  }
  const auto count = static_cast<std::size_t>(last - first);
  std::fill(begins.begin() + static_cast<Index>(count) + 1, begins.end(), begins[count]);

  auto& chunk = rows_.chunk(first);
  const auto lanes = static_cast<std::size_t>(rows_.lanes());
  std::uint32_t slots = 0;
  for (std::size_t row = 0; row < count; row += lanes) {
    std::uint32_t longest = 0;
    for (std::size_t k = row; k < row + lanes; ++k)
      longest = std::max(longest, begins[k + 1] - begins[k]);
    slots += longest;
    chunk.ends[row / lanes] = slots;
  }
  Real* out = chunk.reserve(3 * slots * lanes);
  for (std::size_t row = 0; row < count; row += lanes) {
    const std::size_t begin = row == 0 ? 0 : chunk.ends[row / lanes - 1];
    Real* const end = out + 3 * lanes * (chunk.ends[row / lanes] - begin);
    std::fill(out, end, Records::kFar);
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      Real* at = out + lane;
      for (std::size_t k = begins[row + lane]; k < begins[row + lane + 1]; ++k, at += 3 * lanes) {
        at[0] = sites[k][0];
        at[lanes] = sites[k][1];
        at[2 * lanes] = sites[k][2];
      }
    }
    out = end;
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
