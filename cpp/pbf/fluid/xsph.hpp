#pragma once

#include "pbf/fluid/discretization.hpp"

namespace pbf {

/// XSPH viscosity, Eq. 17 [MM13]:  v_new,i = v_i + strength · V Σ_j (v_j − v_i) W_ij          [m/s]
/// Reads the old velocities and writes new ones: in place, the result would depend on thread
/// timing. With them comes ρ_i/ρ0, which sums the same W: (v_new, ρ/ρ0).
void smooth_velocities(const Neighborhood& near,
                       const Discretization& disc,
                       const Records& x,
                       const Records& v,
                       Real strength,
                       int threads,
                       Records& v_new);

}  // namespace pbf
