#pragma once

#include "pbf/core/isa.hpp"
#include "pbf/render/raster/splat_kernels.hpp"
#include "pbf/render/shares.hpp"

namespace pbf::raster {

/// The inner loop of DeepThickness, for one instruction set.
struct DeepKernels {
  /// Cells of level k are 2^k pixels wide, for k from 1 to this.
  static constexpr int kLevels = 14;
  /// Cells around the picture that are complete, and those that belong to no pixel.
  static constexpr int kMargin = 2;
  /// Cells along a side of the picture, of a level or of each lane's, with the margin.
  template <class Number>
  __attribute__((always_inline)) static Number cells_along(int pixels, Number level) {
    return ((pixels + (1 << level) - 1) >> level) + 2 * kMargin;
  }

  /// What the particles whose flag is 1 add to the levels; those with 0 add nothing.
  /// @param xyz  three numbers each, behind the last kMostLanes more particles' that can be read
  void (*share)(const float* xyz,
                const std::uint8_t* flags,
                Index count,
                const SplatView& view,
                Shares& shares);
};

const DeepKernels& deep_kernels(Isa isa);

}  // namespace pbf::raster
