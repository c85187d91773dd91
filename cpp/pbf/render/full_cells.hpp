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
  /// Makes full ones of the deep cells whose middle x is not behind a plane: direction · x <= from.
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
  /// What `combine` makes of each cell and its neighbors up to `reach` to both sides on each axis.
  template <class Combine>
  void around(Flags& cells, int reach, int threads, Combine&& combine);

  /// Calls f(cell, x, y, z) for all cells but those of the margin.
  template <class F>
  void for_inner(int threads, F&& f) const;

  Real side_ = 0;
  Vec3 first_ = Vec3::Zero();                 // number of the least cell on each axis
  Eigen::Array<Index, 3, 1> sides_{0, 0, 0};  // [cells]
  std::array<Index, 3> strides_{1, 0, 0};
  bool has_all_ = false;
  std::vector<std::uint32_t> cells_;  // of the particles; 0, in the margin, for who is in none
  Flags holds_, full_, near_open_, scratch_;
  std::vector<Place> places_;  // of the cells
};

}  // namespace pbf
