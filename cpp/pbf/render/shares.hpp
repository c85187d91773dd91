#pragma once

#include "pbf/core/records.hpp"

#include <cstdint>

namespace pbf {

/// What some particles add to grids (deposit.hpp). Each adds its amount to four cells, a square of
/// two by two, shared so that its center stays where it is. Plain arrays: loops that are compiled
/// for several instruction sets write them, in whole vectors.
struct Shares {
  static constexpr Index kMost = 1 << 10;  ///< particles
  static constexpr Index kRoom = kMost + kMostLanes;
  std::int32_t grid[kRoom], cell[kRoom];  ///< which, and the lower left one of the four
  float right[kRoom], up[kRoom];          ///< shares of the cells to that side
  float amount[kRoom];                    ///< 0: it adds nothing
};

}  // namespace pbf
