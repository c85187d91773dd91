#pragma once

#include "pbf/core/types.hpp"

#include <array>
#include <vector>

namespace pbf {

/// Tells by cells alone who is within a body of fluid. A cell is *full* if it and the 26 around it
/// all hold particles, and *open* if it holds some and is not full. A particle is *deep* if its
/// cell and those up to two cells away are not open: then nobody sees it from outside of the fluid,
/// and no particle in an open cell is within two cells' sides.
///
/// Cells stand where they do in the world, whatever the particles. All are open where their number
/// would be out of proportion to that of the particles, and where single particles flew off to.
class FullCells {
 public:
  enum class Place : std::uint8_t { open, full, deep };

  /// @param side  of the cells [m]
  void find(const PointsView& positions, Real side, int threads);
  /// Of particle i.
  [[nodiscard]] Place operator[](Index i) const {
    return places_[cells_[static_cast<std::size_t>(i)]];
  }

 private:
  using Flags = std::vector<std::uint8_t>;
  /// What `combine` makes of each cell and its neighbors up to `reach` to both sides on each axis.
  template <class Combine>
  void around(Flags& cells, int reach, int threads, Combine&& combine);

  std::vector<std::uint32_t> cells_;  // of the particles; the first for who is in none
  std::array<Index, 3> strides_{1, 0, 0};
  Flags holds_, full_, near_open_, scratch_;
  std::vector<Place> places_;  // of the cells
};

}  // namespace pbf
