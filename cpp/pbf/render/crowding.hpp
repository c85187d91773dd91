#pragma once

#include "pbf/core/records.hpp"
#include "pbf/core/types.hpp"
#include "pbf/neighbors/cell_grid.hpp"

#include <vector>

namespace pbf {

/// Tells drops from bodies of fluid. The crowding of particle i is
///
///   c_i = max(m_i, max_j min(1, 3/2 u_ij) m_j) / 9,   m_i = min(9, sum_j u_ij^2),
///   u_ij = 1 - |x_j - x_i|^2 / s^2,   over j != i with u_ij > 0.
///
/// 0 for a particle alone within s [m] and 1 in any body of fluid and at its faces, edges and
/// corners, where the inner neighbor counts. With s = 2.4 particle distances c is 0.55 in a sheet
/// of a single layer, 0.4 in a cube of eight and 0.2 in a row.
///
/// Most sums are never made: where m_i is 9, c_j is 1 for every j with u_ij >= 2/3, so that one sum
/// in a body answers for ten particles around.
class Crowding {
 public:
  /// @param positions  finite [m]
  /// @param eye        particles that are more than 2^19 s from here have c = 1: nobody sees them
  /// @param s          0: c = 1 everywhere, at no cost
  void find(const PointsView& positions, const Vec3& eye, Real s, int threads = 0);
  /// Their positions, and c as the fourth number.
  [[nodiscard]] const Records& particles() const { return particles_; }

 private:
  void sort(const PointsView& positions, const Vec3& eye, Real s, int threads);
  void find_crowding(Real s, int threads);
  /// Calls f(k, candidates) for the sorted particles that wanted(k) picks.
  template <class Wanted, class F>
  void for_each(int threads, Wanted&& wanted, F&& f) const;

  CellGrid grid_;
  Records particles_, near_;          ///< all in their order; those not too far, seen from the eye
  std::vector<std::uint32_t> ids_;    ///< of near_ in particles_
  Records sorted_;                    ///< near_ in the order of the grid, with m or −1
  std::vector<std::uint8_t> body_;    ///< c = 1 is known
  std::vector<std::uint8_t> wanted_;  ///< m is needed
};

}  // namespace pbf
