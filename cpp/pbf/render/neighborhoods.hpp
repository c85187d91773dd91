#pragma once

#include "pbf/core/records.hpp"
#include "pbf/neighbors/cell_grid.hpp"
#include "pbf/render/camera.hpp"
#include "pbf/render/full_cells.hpp"

#include <vector>

namespace pbf {

/// Who is around whom, for the passes that look at what is within a distance s of a particle. Those
/// that are deep in a body by cells of side 0.6 s (full_cells.hpp), most of a million, are set
/// apart from the others, the *shallow* ones. Only of these some are sorted: no deep one is within
/// 1.2 s of a particle that can be seen, and of a body only what is beside loose particles is
/// within s of one.
class Neighborhoods {
 public:
  enum class Deep { last, left_out };
  enum class Sorted { around_loose, shallow };
  /// @param positions  finite [m]
  /// @param camera     particles that are more than 2^19 s from it are not sorted: nobody sees them
  /// @param s          0: nobody is sorted, and nobody deep
  /// @param radius     of a body's sprites [m]: only large ones hide what is behind them
  /// @param deep       where deep ones are among the particles()
  /// @param sorted     whose neighborhoods are wanted: loose ones', or of all that are not deep
  void find(const PointsView& positions,
            const Camera& camera,
            Real s,
            Real radius,
            Deep deep,
            Sorted sorted,
            int threads = 0);

  [[nodiscard]] Real distance() const { return s_; }
  /// Positions in the order given, but deep ones last or left out. The fourth number is 1, for
  /// passes to set.
  [[nodiscard]] Records& particles() { return particles_; }
  [[nodiscard]] const Records& particles() const { return particles_; }
  /// Where they are, in the order given: deep ones are so deep in a body, and behind the near
  /// plane, that others hide them.
  [[nodiscard]] const std::vector<FullCells::Place>& places() const { return places_; }
  /// How many are not deep, and their positions.
  [[nodiscard]] Index shallow_count() const { return shallow_; }
  [[nodiscard]] auto shallow() const {
    using Strided = Eigen::Map<const Points, Eigen::Unaligned, Eigen::OuterStride<>>;
    return Strided(&particles_.data()->x, 3, shallow_, Eigen::OuterStride<>(4));
  }

  /// Those to sort by cell, seen from the eye; their fourth number means nothing.
  [[nodiscard]] const Records& sorted() const { return sorted_; }
  /// Of each of these, 1 in a body and 0 for a loose one.
  [[nodiscard]] const std::vector<std::uint8_t>& in_body() const { return in_body_; }
  /// Where the k-th of these is in particles().
  [[nodiscard]] Index place(std::uint32_t k) const { return ids_[grid_.order()[k]]; }

  [[nodiscard]] const CellGrid& grid() const { return grid_; }

 private:
  void part(const PointsView& positions,
            const Camera& camera,
            Deep deep,
            FullCells::Place sorted_to,
            int threads);
  void sort(int threads);

  Real s_ = 0;
  FullCells cells_;
  CellGrid grid_;
  std::vector<FullCells::Place> places_;  ///< in the order given
  Records particles_;                     ///< all
  Records near_;                          ///< to sort: seen from the eye, and 1 in a body
  Index shallow_ = 0;
  std::vector<std::uint32_t> ids_;  ///< of near_: places in particles_
  Records sorted_;                  ///< near_ in the order of the grid
  std::vector<std::uint8_t> in_body_;
};

}  // namespace pbf
