#pragma once

#include "pbf/core/isa.hpp"
#include "pbf/render/raster/surroundings.hpp"

namespace pbf::raster {

/// A stage of a time step, as numbers (glsl/curvature_flow.frag).
struct FlowTerms {
  bool perspective;
  float width, height;            ///< [pixels]
  float half_width, half_height;  ///< of what is seen at depth 1, in perspective
  float pixels_per_meter;         ///< in perspective at depth 1
  float range;                    ///< [m]
  float variance;                 ///< [m²]
  float stage, stages;
};

/// The inner loop of curvature flow, for one instruction set.
struct FlowKernels {
  /// Writes a tile of `out`. @param around  a pixel to each side, of the last stage
  /// @param previous  the stage before that
  void (*stage)(const FlowTerms& terms,
                const Surroundings& around,
                const Map& previous,
                const Map& spheres,
                Tile tile,
                Map& out);
};

const FlowKernels& flow_kernels(Isa isa);

}  // namespace pbf::raster
