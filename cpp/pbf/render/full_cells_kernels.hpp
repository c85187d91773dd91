#pragma once

#include "pbf/core/isa.hpp"
#include "pbf/core/records.hpp"

#include <cstdint>

namespace pbf {

/// A block of cubic cells, numbered along x, then y, then z.
struct CellBlock {
  float cells_per_meter;
  float first[3];  ///< the least cell's number on each axis
  float counts[3];
  std::int32_t strides[3];
};

/// The inner loop of FullCells, for one instruction set.
struct FullCellsKernels {
  /// The particles' cells, 0 for those outside of the block.
  /// @param xyz    three numbers each, behind the last kMostLanes more particles' that can be read
  /// @param cells  kMostLanes more may be written
  void (*locate)(const Real* xyz, Index count, const CellBlock& block, std::uint32_t* cells);
};

const FullCellsKernels& full_cells_kernels(Isa isa);

}  // namespace pbf
