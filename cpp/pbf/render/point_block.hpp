#pragma once

#include "pbf/core/records.hpp"
#include "pbf/core/types.hpp"

#include <vector>

namespace pbf {

/// The positions [first, last) as loops in lanes read them: three numbers each, side by side, and
/// behind the last kMostLanes more that can be read. Copied to `room` if they do not lie like that.
inline const Real* point_block(const PointsView& positions,
                               Index first,
                               Index last,
                               std::vector<Real>& room) {
  const bool lies_so = positions.outerStride() == 3 && last + kMostLanes < positions.cols();
  if (lies_so) return positions.data() + 3 * first;
  room.assign(static_cast<std::size_t>(3 * (last - first + kMostLanes) + 1), 0);
  Eigen::Map<Points>(room.data(), 3, last - first) = positions.middleCols(first, last - first);
  return room.data();
}

}  // namespace pbf
