#include "pbf/fluid/xsph.hpp"

#include "pbf/core/parallel.hpp"

namespace pbf {

void smooth_velocities(const Neighborhood& near,
                       const Discretization& disc,
                       const PointsView& x,
                       const PointsView& v,
                       Real strength,
                       int threads,
                       Points& v_new) {
  v_new.resize(3, x.cols());
  const Real scale = strength * disc.V;
  with_kernel(disc.fluid.kernel, disc.h, [&](const auto& kernel) {
    parallel_for(x.cols(), threads, [&](Index i) {
      const Vec3 x_i = x.col(i), v_i = v.col(i);
      Vec3 sum = Vec3::Zero();
      for (const std::uint32_t j : near.fluid[i]) {
        sum += kernel.W((x_i - x.col(j)).squaredNorm()) * (v.col(j) - v_i);
      }
      v_new.col(i) = v_i + scale * sum;
    });
  });
}

}  // namespace pbf
