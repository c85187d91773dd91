#pragma once

#include "pbf/core/parallel.hpp"
#include "pbf/fluid/discretization.hpp"
#include "pbf/fluid/sweeps.hpp"

namespace pbf {

/// Calls f(sweeps, VW, stretch) for stretches that cover all particles, several at once: sweeps are
/// the loops for the fluid's kernel and the lists' instruction set, VW is the kernel times V.
template <class F>
void sweep(const Neighborhood& near, const Discretization& disc, int threads, F&& f) {
  const FluidParams& fluid = disc.fluid;
  with_kernel(fluid.kernel_in_force(), fluid.dimensions, disc.h, disc.V, [&](const auto& VW) {
    const auto& loops = sweeps(VW, near.fluid.isa());
    parallel_chunks(near.fluid.size(), threads, kChunk, [&](Index first, Index last) {
      f(loops, VW, Stretch{first, last, near.fluid.view(first), near.boundary.view(first)});
    });
  });
}

}  // namespace pbf
