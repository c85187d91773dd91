#pragma once

#include "pbf/core/records.hpp"
#include "pbf/fluid/discretization.hpp"

#include <cstdint>
#include <optional>
#include <vector>

namespace pbf {

/// What a simulation knows of its particles between steps, sorted by the cells of the last one.
struct State {
  Records x;                       ///< (x, λ)
  Records v;                       ///< (v, ρ/ρ0)
  std::vector<Real> totals;        ///< Λ
  std::vector<std::uint32_t> ids;  ///< the row that a particle has outside
};

/// The state with more particles behind those that are there. Throws InvalidParameter as
/// Simulation::add_particles says.
State with_particles(State state,
                     const PointsView& positions,
                     const std::optional<Points>& velocities,
                     const Discretization& disc);

}  // namespace pbf
