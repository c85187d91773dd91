#pragma once

#include "pbf/core/types.hpp"
#include "pbf/neighbors/cell_grid.hpp"

#include <functional>
#include <vector>

namespace pbf {

/// What is around each particle: for passes that look at all within a distance s [m].
class Neighborhoods {
 public:
  /// Sorts particles into cells of side s > 0. Those that are more than 2^19 s from the eye are
  /// left out: nobody sees them.
  void find(const Records& particles, const Vec3& eye, Real s, int threads);

  /// The particle's number, its position seen from the eye, and the particles within s of it,
  /// itself among them, with others that are farther away.
  using Visit = std::function<void(Index i, const Record& x, const Candidates& candidates)>;
  /// For the first `count` particles.
  void for_each(Index count, int threads, const Visit& visit) const;

 private:
  CellGrid grid_;
  std::vector<std::uint32_t> ids_;  ///< of those not too far
  Records sorted_;                  ///< their positions seen from the eye, by cell
};

}  // namespace pbf
