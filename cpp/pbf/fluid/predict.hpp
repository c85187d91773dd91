#pragma once

#include "pbf/fluid/discretization.hpp"

namespace pbf {

/// x* = project(x + dt (v + dt g)): where each particle would be without the others, moved out of
/// the walls, and along periodic axes back into the domain, of which u knows nothing. Algorithm 1,
/// lines 1–4 [MM13]. v itself is not changed: the velocity update reads the displacement u = x* − x
/// only.
///
/// u is kept beside x* and added up from its parts. The difference of the positions would carry
/// their rounding into the velocities, EPS ‖x‖/dt, alike for all particles that share a coordinate:
/// drops in open space would gain momentum, the more the farther from the origin.
void predict(const Records& x,
             const Records& v,
             const Discretization& disc,
             Real dt,
             int threads,
             Records& x_star,
             Records& u);

/// v = u/dt = (x* − x)/dt   Algorithm 1, line 20 [MM13].
void update_velocity(const Records& u, Real dt, int threads, Records& v);

}  // namespace pbf
