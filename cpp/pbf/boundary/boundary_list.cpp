#include "pbf/boundary/boundary_list.hpp"

#include "pbf/core/parallel.hpp"

namespace pbf {

void BoundaryList::build(const std::optional<WallLattice>& walls,
                         const PointsView& x,
                         int threads) {
  rows_.resize(x.cols());
  parallel_chunks(x.cols(), threads, kChunk, [&](Index first, Index last) {
    auto& list = rows_.chunk(first);
    list.clear();
    for (Index i = first; i < last; ++i) {
      const std::size_t row = list.size();
      if (walls) walls->for_each_near(x.col(i), [&](const Vec3& q) { list.push_back(q); });
      rows_.set_row(i, row, list.size());
    }
  });
}

}  // namespace pbf
