#pragma once

#include "pbf/core/records.hpp"
#include "pbf/core/types.hpp"
#include "pbf/neighbors/cell_grid.hpp"
#include "pbf/render/camera.hpp"
#include "pbf/render/full_cells.hpp"

#include <vector>

namespace pbf {

/// Tells drops from bodies of fluid. The crowding of particle i is
///
///   c_i = max(m_i, max_j min(1, 3/2 u_ij) m_j) / 9,   u_ij = 1 - |x_j - x_i|^2 / s^2,
///   m_i = 9 in a full cell of side 0.6 s (full_cells.hpp), elsewhere min(9, sum_j u_ij^2),
///
/// over j != i with u_ij > 0. 0 for a particle alone within s [m] and 1 in any body of fluid and at
/// its faces, edges and corners, where the inner neighbor counts. With s = 2.4 particle distances c
/// is 0.55 in a sheet of a single layer, 0.4 in a cube of eight and 0.2 in a row.
///
/// In a full cell the sum is 9 as well, but for one particle in thousands. Particles deep within a
/// body, most of a million, are not looked at again. And where m_i is 9, c_j is 1 for every j with
/// u_ij >= 2/3, so that one sum answers for ten particles around.
class Crowding {
 public:
  /// @param positions  finite [m]
  /// @param camera     particles that are more than 2^19 s from it have c = 1: nobody sees them
  /// @param s          0: c = 1 everywhere, at no cost
  /// @param radius     of a body's sprites [m]: only large ones hide what is behind them
  void find(
      const PointsView& positions, const Camera& camera, Real s, Real radius, int threads = 0);
  /// Their positions in the order given, but deep ones last, and c as the fourth number.
  [[nodiscard]] const Records& particles() const { return particles_; }
  /// How many of them are so deep in a body, and behind the near plane, that others hide them.
  [[nodiscard]] Index deep() const { return deep_; }
  /// Positions of the others.
  [[nodiscard]] auto shallow() const {
    using Strided = Eigen::Map<const Points, Eigen::Unaligned, Eigen::OuterStride<>>;
    return Strided(&particles_.data()->x, 3, particles_.size() - deep_, Eigen::OuterStride<>(4));
  }

 private:
  /// Parts deep particles from the others and picks those to look at.
  void part(const PointsView& positions, const Camera& camera, Real s, Real radius, int threads);
  void sort(Real s, int threads);
  void find_crowding(Real s, int threads);
  /// Calls f(k, candidates) for the sorted particles that wanted(k) picks.
  template <class Wanted, class F>
  void for_each(int threads, Wanted&& wanted, F&& f) const;

  FullCells cells_;
  CellGrid grid_;
  std::vector<FullCells::Place> places_;  ///< in the order given
  Records particles_;                     ///< all
  Records near_;                          ///< to look at: seen from the eye, and m or −1
  Index deep_ = 0;
  std::vector<std::uint32_t> ids_;    ///< of near_: places in particles_
  Records sorted_;                    ///< near_ in the order of the grid
  std::vector<std::uint8_t> full_;    ///< in a full cell
  std::vector<std::uint8_t> body_;    ///< c = 1 is known
  std::vector<std::uint8_t> wanted_;  ///< m is needed
};

}  // namespace pbf
