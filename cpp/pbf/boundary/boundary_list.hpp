#pragma once

#include "pbf/boundary/wall_lattice.hpp"
#include "pbf/neighbors/neighbor_list.hpp"

#include <optional>
#include <span>

namespace pbf {

/// For each particle the boundary particles within h; they do not move, so their positions are the
/// list.
class BoundaryList {
 public:
  /// Without walls every row is empty.
  void build(const std::optional<WallLattice>& walls, const PointsView& x, int threads);

  [[nodiscard]] std::span<const Vec3> operator[](Index i) const { return rows_[i]; }

 private:
  Rows<Vec3> rows_;
};

}  // namespace pbf
