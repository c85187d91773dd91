#pragma once

#include "pbf/fluid/simulation.hpp"
#include "pbf/scene/shapes.hpp"

#include <cmath>

namespace pbf::bench {

/// A cube of about n particles about to fall over in a tank three times as long.
inline Simulation dam_break(Index n, int threads) {
  const FluidParams fluid;
  const Real side = fluid.spacing * static_cast<Real>(std::lround(std::cbrt(n)));
  Simulation simulation(fluid, SolverParams{.num_threads = threads},
                        Box{.lower{0, 0, 0}, .upper{3 * side, 2 * side, side}});
  simulation.add_particles(block({0, 0, 0}, {side, side, side}, fluid.spacing));
  return simulation;
}

}  // namespace pbf::bench
