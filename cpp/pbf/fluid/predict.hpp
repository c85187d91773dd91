#pragma once

#include "pbf/fluid/discretization.hpp"

namespace pbf {

/// x* = project(x + dt (v + dt g)): where each particle would be without the others, moved out of
/// the walls. Algorithm 1, lines 1–4 [MM13]. v itself is not changed: the velocity update reads
/// positions only.
void predict(const PointsView& x,
             const PointsView& v,
             const Discretization& disc,
             Real dt,
             int threads,
             Points& x_star);

/// v = (x* − x)/dt   Algorithm 1, line 20 [MM13].
void update_velocity(
    const PointsView& x, const PointsView& x_star, Real dt, int threads, Points& v);

}  // namespace pbf
