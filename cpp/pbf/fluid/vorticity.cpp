#include "pbf/fluid/vorticity.hpp"

#include "pbf/fluid/sweep.hpp"

namespace pbf {

void compute_vorticity(const Neighborhood& near,
                       const Discretization& disc,
                       const Records& x,
                       const Records& v,
                       int threads,
                       Records& omega,
                       Records& x_strength) {
  omega.resize(x.size());
  x_strength.resize(x.size());
  sweep(near, disc, threads, [&](const auto& loops, const auto& VW, const Stretch& at) {
    loops.vorticity(VW, at, x.data(), v.data(), omega.data(), x_strength.data());
  });
  near.ghosts.refresh_positions(x_strength, threads);
}

void confine_vorticity(const Neighborhood& near,
                       const Discretization& disc,
                       const Records& x_strength,
                       const Records& omega,
                       Real strength,
                       Real dt,
                       int threads,
                       Records& v) {
  sweep(near, disc, threads, [&](const auto& loops, const auto& VW, const Stretch& at) {
    loops.confinement(VW, at, dt * strength, x_strength.data(), omega.data(), v.data());
  });
  near.ghosts.refresh(v, threads);
}

}  // namespace pbf
