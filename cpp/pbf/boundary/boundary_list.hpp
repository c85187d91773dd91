#pragma once

#include "pbf/boundary/wall_lattice.hpp"
#include "pbf/core/records.hpp"
#include "pbf/neighbors/sliced_rows.hpp"

#include <optional>

namespace pbf {

/// For each particle the boundary particles within h; they do not move, so their positions are the
/// list: a slot holds the x of its lanes, then the y, then the z.
class BoundaryList {
 public:
  /// Without walls every row is empty.
  /// @param x      positions of the particles; ghosts may stand behind them
  /// @param lanes  particles in a slice
  void build(const std::optional<WallLattice>& walls,
             const Records& x,
             Index particles,
             int lanes,
             int threads);

  [[nodiscard]] std::size_t bytes() const { return rows_.bytes(); }
  [[nodiscard]] SliceView<Real> view(Index first) const { return rows_.view(first); }
  /// Positions of the boundary particles near i.
  [[nodiscard]] std::vector<Vec3> operator[](Index i) const;

 private:
  void build_chunk(const WallLattice& walls, const Records& x, Index first, Index last);

  SlicedRows<Real> rows_;
};

}  // namespace pbf
