#pragma once

#include "pbf/core/records.hpp"
#include "pbf/fluid/discretization.hpp"

#include <array>
#include <cstdint>

namespace pbf {

/// Corners of a cell: bits 0, 1, 2 of a corner's number are its x, y, z.
inline constexpr int kCorners = 8;
template <class T>
using PerCorner = std::array<T, kCorners>;

/// Three whole numbers in one: a cell, or its corner at the lower coordinates.
using CellKey = std::uint64_t;

/// A grid of cells six spacings wide over all space, with the trilinear functions of its corners.
/// Along periodic axes a whole number of them makes a period, and the last is next to the first; in
/// 2-D there is one along z, in which nothing changes.
class CoarseGrid {
 public:
  explicit CoarseGrid(const Discretization& disc);

  /// The functions of the corners around a point.
  struct Hats {
    CellKey cell;
    PerCorner<Real> w;                  ///< they add up to 1
    std::array<PerCorner<Real>, 3> dw;  ///< their slopes along x, y, z [1/m]
  };
  [[nodiscard]] Hats at(const Record& x) const;
  [[nodiscard]] CellKey corner(CellKey cell, int number) const;

 private:
  struct Axis {
    Real origin = 0, per_width = 0;
    std::int64_t period = 0;  // in cells, 0: none
  };
  std::array<Axis, 3> axes_;
};

}  // namespace pbf
