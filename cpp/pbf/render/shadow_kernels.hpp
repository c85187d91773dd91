#pragma once

#include "pbf/core/isa.hpp"
#include "pbf/render/shares.hpp"

namespace pbf {

/// Where a position is in the shadow's texels: (u, v) = rows · (x - center) + (du, dv).
struct ShadowFrame {
  float center[3];
  float u[3], v[3];  ///< [texels/m]
  float du, dv;
  int width, height;
};

/// The inner loop of SunShadow, for one instruction set.
struct ShadowKernels {
  /// What the particles add to the one grid: this amount each, if they are in it.
  /// @param xyz  three numbers each, behind the last kMostLanes more particles' that can be read
  void (*share)(
      const Real* xyz, Index count, const ShadowFrame& frame, float amount, Shares& shares);
};

const ShadowKernels& shadow_kernels(Isa isa);

}  // namespace pbf
