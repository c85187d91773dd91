#pragma once

#include "pbf/fluid/coarse_grid.hpp"

#include <span>
#include <vector>

namespace pbf {

/// What the particles of a cell contribute to the equations of its corners.
struct CoarseCell {
  PerCorner<PerCorner<Real>> matrix{};
  PerCorner<Real> right{};
  CoarseCell& operator+=(const CoarseCell& other);
};

/// The equations of the corners of cells, kept cell by cell: A μ = b with A and b the sums of what
/// the cells contribute.
class CoarseSystem {
 public:
  /// Begins with cells that contribute nothing yet, in the order of their keys.
  /// @param cells  in any order, and more than once
  void reset(const CoarseGrid& grid, std::vector<CellKey>& cells, int threads);

  [[nodiscard]] std::uint32_t place(CellKey cell) const;
  [[nodiscard]] CoarseCell& operator[](std::uint32_t place) { return cells_[place]; }

  /// Conjugate gradients [HS52], preconditioned by the diagonal, until their residual is a tenth of
  /// what it was: more would be lost in what the particles make of it.
  void solve(int threads);
  [[nodiscard]] PerCorner<Real> solution(std::uint32_t place) const;

  [[nodiscard]] std::size_t bytes() const;

 private:
  void multiply(const std::vector<double>& p, int threads, std::vector<double>& Ap);
  template <class F>
  [[nodiscard]] double at_corner(std::size_t corner, F&& part) const;

  std::vector<CellKey> keys_;  // of the cells, ascending
  std::vector<CoarseCell> cells_;
  std::vector<PerCorner<std::uint32_t>> corners_;  // of each cell: places in the vectors below
  std::vector<PerCorner<std::int64_t>> around_;    // of each corner: 8 cell + corner of it, or -1
  std::vector<PerCorner<double>> parts_;           // of each cell, of a product
  std::vector<double> mu_, r_, z_, p_, Ap_, inverse_diagonal_;
};

}  // namespace pbf
