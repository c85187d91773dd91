#include "pbf/fluid/state.hpp"

#include "pbf/core/error.hpp"

#include <string>

namespace pbf {
namespace {

std::string particle_text(const PointsView& points, Index i) {
  return "particle " + std::to_string(i) + " at " + to_text(Vec3(points.col(i)));
}

/// In 2-D all particles lie in the plane of the first one, and stay there.
void require_plane(Real plane,
                   const PointsView& positions,
                   const std::optional<Points>& velocities,
                   Index i) {
  if (positions(2, i) != plane) {
    throw InvalidParameter("positions: " + particle_text(positions, i) + " m; z must be " +
                           to_text(plane) + " m, that of the first particle, in 2-D");
  }
  if (velocities && (*velocities)(2, i) != 0) {
    throw InvalidParameter("velocities: " + particle_text(*velocities, i) +
                           " m/s; z must be 0 in 2-D");
  }
}

void require_sound(const State& state,
                   const PointsView& positions,
                   const std::optional<Points>& velocities,
                   const Discretization& disc) {
  const Index added = positions.cols();
  if (velocities && velocities->cols() != added) {
    throw InvalidParameter("velocities: " + std::to_string(velocities->cols()) +
                           " rows, but positions has " + std::to_string(added) + "; must be equal");
  }
  for (Index i = 0; i < added; ++i) {
    const Vec3 x = positions.col(i);
    if (!x.allFinite())
      throw InvalidParameter("positions: " + particle_text(positions, i) + " m; must be finite");
    if (velocities && !velocities->col(i).allFinite()) {
      throw InvalidParameter("velocities: " + particle_text(*velocities, i) +
                             " m/s; must be finite");
    }
    if (disc.fluid.dimensions == 2) {
      const Real plane = state.x.size() > 0 ? state.x[0].z : positions(2, 0);
      require_plane(plane, positions, velocities, i);
    }
    if (!CellGrid::reaches(x, disc.h)) {
      throw InvalidParameter("positions: " + particle_text(positions, i) + " m; " +
                             CellGrid::reach_text(disc.h));
    }
    if (!disc.contains(x)) {
      throw InvalidParameter("positions: " + particle_text(positions, i) +
                             " m is outside the domain; must be within " +
                             to_text(disc.domain->lower) + " and " + to_text(disc.domain->upper) +
                             " m");
    }
  }
  if (const Index all = state.x.size() + added; all > kMostParticles) {
    throw InvalidParameter("positions: " + std::to_string(all) + " particles are more than the " +
                           std::to_string(kMostParticles) + " that a simulation can hold");
  }
}

}  // namespace

State with_particles(State state,
                     const PointsView& positions,
                     const std::optional<Points>& velocities,
                     const Discretization& disc) {
  require_sound(state, positions, velocities, disc);
  const Index before = state.x.size(), added = positions.cols();
  const auto wrapped = [&](int axis, Real x) {
    return disc.domain ? disc.domain->wrap(axis, x) : x;
  };
  state.x.resize(before + added);
  state.v.resize(before + added);
  state.ids.resize(static_cast<std::size_t>(before + added));
  state.totals.resize(static_cast<std::size_t>(before + added));
  for (Index i = 0; i < added; ++i) {
    const Vec3 x = positions.col(i);
    const Vec3 v = velocities ? Vec3(velocities->col(i)) : Vec3(Vec3::Zero());
    state.x[before + i] = {wrapped(0, x[0]), wrapped(1, x[1]), wrapped(2, x[2]), 0};
    state.v[before + i] = {v[0], v[1], v[2], 0};
    state.ids[static_cast<std::size_t>(before + i)] = static_cast<std::uint32_t>(before + i);
  }
  return state;
}

}  // namespace pbf
