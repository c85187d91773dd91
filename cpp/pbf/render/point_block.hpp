#pragma once

#include "pbf/core/records.hpp"
#include "pbf/core/types.hpp"

#include <vector>

namespace pbf {

/// The positions [first, last) as loops in lanes read them: three numbers each, side by side, and
/// behind the last kMostLanes more that can be read. If they do not lie like that, a copy, which
/// lives until the thread asks for another block.
inline const Real* point_block(const PointsView& positions, Index first, Index last) {
  const bool lies_so = positions.outerStride() == 3 && last + kMostLanes < positions.cols();
  if (lies_so) return positions.data() + 3 * first;
  thread_local std::vector<Real> room;
  room.assign(static_cast<std::size_t>(3 * (last - first + kMostLanes) + 1), 0);
  Eigen::Map<Points>(room.data(), 3, last - first) = positions.middleCols(first, last - first);
  return room.data();
}

}  // namespace pbf
