#pragma once

#include "pbf/render/neighborhoods.hpp"

#include <vector>

namespace pbf {

/// Tells drops from bodies of fluid. The crowding of particle i is
///
///   c_i = max(m_i, max_j min(1, 3/2 u_ij) m_j) / 9,   u_ij = 1 - |x_j - x_i|^2 / s^2,
///   m_i = 9 in a body by cells of side 0.6 s (full_cells.hpp), elsewhere min(9, sum_j u_ij^2),
///
/// over j != i with u_ij > 0. 0 for a particle alone within s [m] and 1 in any body of fluid and at
/// its faces, edges and corners, where the inner neighbor counts. With s = 2.4 particle distances c
/// is 0.55 in a sheet of a single layer, 0.4 in a cube of eight and 0.2 in a row.
///
/// By sums alone c is 0.9 or more in such a body as well, but for spray so dense that drops fill 27
/// cells.
class Crowding {
 public:
  /// Writes c as the particles' fourth number. Of those that are not sorted it stays as it is.
  void find(Neighborhoods& particles, int threads = 0);

 private:
  std::vector<Real> m_;  // of the sorted particles
};

}  // namespace pbf
