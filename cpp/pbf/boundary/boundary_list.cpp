#include "pbf/boundary/boundary_list.hpp"

#include "pbf/core/parallel.hpp"

namespace pbf {

void BoundaryList::build(const std::optional<WallLattice>& walls,
                         const Records& x,
                         int lanes,
                         int threads) {
  rows_.resize(x.size(), lanes);
  parallel_chunks(x.size(), threads, kChunk, [&](Index first, Index last) {
    auto& chunk = rows_.chunk(first);
    chunk.ends.fill(0);
    if (!walls) return;
    thread_local std::vector<Vec3> sites;
    std::array<std::size_t, static_cast<std::size_t>(kChunk + 1)> begins{};
    sites.clear();
    for (Index i = first; i < last; ++i) {
      walls->for_each_near({x[i].x, x[i].y, x[i].z}, [&](const Vec3& q) { sites.push_back(q); });
      begins[static_cast<std::size_t>(i - first + 1)] = sites.size();
    }
    const auto length = [&](Index row) {
      const auto k = static_cast<std::size_t>(row);
      return row < last - first ? begins[k + 1] - begins[k] : 0;
    };
    std::uint32_t slots = 0;
    for (Index slice = 0; slice < last - first; slice += lanes) {
      std::size_t longest = 0;
      for (int lane = 0; lane < lanes; ++lane) longest = std::max(longest, length(slice + lane));
      slots += static_cast<std::uint32_t>(longest);
      chunk.ends[static_cast<std::size_t>(slice / lanes)] = slots;
    }
    Real* const out =
        chunk.reserve(static_cast<std::size_t>(slots) * 3 * static_cast<std::size_t>(lanes));
    std::uint32_t slot = 0;
    for (Index slice = 0; slice < last - first; slice += lanes) {
      const std::uint32_t end = chunk.ends[static_cast<std::size_t>(slice / lanes)];
      for (std::size_t k = 0; slot < end; ++slot, ++k) {
        for (int lane = 0; lane < lanes; ++lane) {
          const bool has = k < length(slice + lane);
          Real* const at = out + static_cast<Index>(slot) * 3 * lanes + lane;
          for (int axis = 0; axis < 3; ++axis) {
            at[axis * lanes] = has ? sites[begins[static_cast<std::size_t>(slice + lane)] + k][axis]
                                   : Records::kFar;
          }
        }
      }
    }
  });
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
