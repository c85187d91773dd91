#pragma once

#include "pbf/render/deposit.hpp"
#include "pbf/render/full_cells.hpp"
#include "pbf/render/raster/map.hpp"
#include "pbf/render/raster/splat_kernels.hpp"

namespace pbf::raster {

/// Thickness of what lies deep in a body (full_cells.hpp): where nobody sees a single particle
/// there are no edges to keep. Each adds its volume to four cells of a grid over the picture, of
/// the coarsest whose cells, 2, 4, 8 … pixels wide, are no wider than the sprite's radius. Coarse
/// grids are interpolated to finer ones, and the finest to pixels.
class DeepThickness {
 public:
  /// @param places  of the particles
  void find(const PointsView& positions,
            const std::vector<FullCells::Place>& places,
            const SplatView& view,
            int threads);
  /// Adds it to the pixels in the tiles.
  void add_to(Map& thickness, const Tiles& tiles, int threads) const;

 private:
  Deposit deposit_;
  std::vector<Deposit::Size> sizes_;  // of the levels, with cells 1, 2, 4 … pixels wide
  std::vector<Real> cells_, finer_;   // of level 1; none: nothing is deep
};

}  // namespace pbf::raster
