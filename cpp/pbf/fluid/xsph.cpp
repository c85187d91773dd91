#include "pbf/fluid/xsph.hpp"

#include "pbf/fluid/sweep.hpp"

namespace pbf {

void smooth_velocities(const Neighborhood& near,
                       const Discretization& disc,
                       const Records& x,
                       const Records& v,
                       Real strength,
                       int threads,
                       Records& v_new) {
  v_new.resize(x.size());
  sweep(near, disc, threads, [&](const auto& loops, const auto& VW, const Stretch& at) {
    loops.xsph(VW, at, strength, x.data(), v.data(), v_new.data());
  });
}

}  // namespace pbf
