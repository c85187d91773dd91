#pragma once

#include "pbf/core/isa.hpp"
#include "pbf/core/records.hpp"
#include "pbf/render/raster/scene.hpp"

namespace pbf {

/// The inner loop of nearest_front(), for one instruction set.
struct NearestKernels {
  /// Depth of the nearest front of those seen, more than any if none is.
  /// @param xyz     three numbers each, behind the last kMostLanes more particles' that can be read
  /// @param beyond  how far a sphere reaches over the picture's sides [m]
  float (*nearest)(const float* xyz,
                   Index count,
                   float radius,
                   const float (&beyond)[2],
                   const raster::FrameTerms& frame);
};

const NearestKernels& nearest_kernels(Isa isa);

}  // namespace pbf
