#pragma once

#include "pbf/core/isa.hpp"
#include "pbf/core/records.hpp"

namespace pbf {

/// What is measured along three axes.
struct ExtentAxes {
  static constexpr float kBeyond = 1e15F;  ///< coordinates end here: sums of squares stay finite
  float axes[3][3];
  float origin[3];          ///< along them; sums are of differences to it
  float least[3], most[3];  ///< other coordinates do not count
};

/// Of a block's coordinates along one axis. Sums are made of this many, the same with every
/// instruction set.
struct ExtentPart {
  float lower, upper;
  float sums[kMostLanes], squares[kMostLanes];
};

/// The inner loop of extent(), for one instruction set.
struct ExtentKernels {
  /// @param xyz  three numbers each, behind the last kMostLanes more particles' that can be read
  void (*measure)(const Real* xyz, Index count, const ExtentAxes& axes, ExtentPart (&parts)[3]);
};

const ExtentKernels& extent_kernels(Isa isa);

}  // namespace pbf
