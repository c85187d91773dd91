#pragma once

#include "pbf/core/types.hpp"

#include <array>
#include <vector>

namespace pbf {

/// Tells by cells alone who is in a body of fluid. A cell is *full* if it and the 26 around it all
/// hold particles. A particle is of a *body* if it lies in such a block of 27, that is, if its cell
/// or one around it is full; others are *loose*: drops, spray, sheets, and the sharp edges of
/// bodies. It is *deep* if of the cells up to two away from its own all that hold particles are
/// full: then nobody sees it from outside of the fluid.
///
/// Cells stand where they do in the world, whatever the particles. All are loose where the number
/// of cells would be out of proportion to theirs, and so are single ones that flew off.
class FullCells {
 public:
  /// Of a body, *beside* is who has a loose particle at most two cells away.
  enum class Place : std::uint8_t { loose, beside, body, deep };

  /// @param side  of the cells [m]
  void find(const PointsView& positions, Real side, int threads);
  /// Of deep cells whose middle x is not behind a plane, direction · x <= from, none is deep.
  void expose(const Vec3& direction, Real from, int threads);

  /// Of particle i.
  [[nodiscard]] Place operator[](Index i) const {
    return places_[cells_[static_cast<std::size_t>(i)]];
  }
  /// Whether all particles are in cells: whoever flew off is not.
  [[nodiscard]] bool has_all() const { return has_all_; }
  /// Corners of the block of all cells [m].
  [[nodiscard]] Vec3 lower() const { return side_ * first_; }
  [[nodiscard]] Vec3 upper() const { return side_ * (first_ + sides_.cast<Real>().matrix()); }

 private:
  using Flags = std::vector<std::uint8_t>;
  using CellNumber = Eigen::Array<Index, 3, 1>;

  void find_places(int threads);
  /// What `combine` makes of each cell and its neighbors up to `reach` to both sides on each axis;
  /// in the margin anything.
  template <class Combine>
  void around(Flags& cells, int reach, int threads, Combine&& combine);
  /// Calls f(k, number on each axis) for all cells.
  template <class F>
  void for_cells(int threads, F&& f) const;

  Real side_ = 0;
  Vec3 first_ = Vec3::Zero();  // number of the least cell on each axis
  CellNumber sides_{0, 0, 0};  // [cells]
  std::array<Index, 3> strides_{1, 0, 0};
  bool has_all_ = false;
  std::vector<std::uint32_t> cells_;  // of the particles; 0, in the margin, for who is in none
  Flags holds_, full_, body_, near_, scratch_;
  std::vector<Place> places_;  // of the cells
};

}  // namespace pbf
