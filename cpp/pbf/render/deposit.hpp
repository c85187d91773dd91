#pragma once

#include "pbf/core/types.hpp"
#include "pbf/render/shares.hpp"

#include <functional>
#include <span>
#include <vector>

namespace pbf {

/// Grids that particles add amounts to, in the same bits for any number of threads.
class Deposit {
 public:
  struct Size {
    int width, height;  ///< cells
  };
  /// Writes what the particles [first, last) add, no more than Shares::kMost. All cells must be in
  /// their grids.
  using Find = void(Index first, Index last, Shares& shares);

  /// Empties the grids, and adds what n particles do.
  void add(std::span<const Size> grids, Index n, int threads, const std::function<Find>& find);

  /// Whether anything was added to it.
  [[nodiscard]] bool has(std::size_t grid) const;
  /// Adds its cells' sums to these, as many as it has cells.
  void add_to(std::span<Real> cells, std::size_t grid, int threads) const;

 private:
  /// Particles are added up in parts, each in grids of its own: how many does not depend on the
  /// number of threads.
  struct Part {
    std::vector<std::vector<Real>> room;  // of each grid, kept
    std::vector<Real*> cells;             // null: nothing was added
    void add(const Shares& shares, Index count, std::span<const Size> grids);
  };
  std::vector<Part> parts_;
};

}  // namespace pbf
