#include "pbf/fluid/vorticity.hpp"

#include "pbf/core/parallel.hpp"
#include "pbf/fluid/field_operators.hpp"

namespace pbf {

void compute_vorticity(const Neighborhood& near,
                       const Discretization& disc,
                       const PointsView& x,
                       const PointsView& v,
                       int threads,
                       Points& omega) {
  omega.resize(3, x.cols());
  with_kernel(disc.fluid.kernel, disc.h, [&](const auto& kernel) {
    const FieldSample sample{x, near.fluid, kernel, disc.V};
    parallel_for(x.cols(), threads, [&](Index i) { omega.col(i) = curl_at(sample, i, v); });
  });
}

void confine_vorticity(const Neighborhood& near,
                       const Discretization& disc,
                       const PointsView& x,
                       const PointsView& omega,
                       Real strength,
                       Real dt,
                       int threads,
                       Points& v) {
  with_kernel(disc.fluid.kernel, disc.h, [&](const auto& kernel) {
    const FieldSample sample{x, near.fluid, kernel, disc.V};
    parallel_for(x.cols(), threads, [&](Index i) {
      Vec3 sum = Vec3::Zero();
      sample.for_each_gradient(i, [&](Index j, const Vec3& grad_W, const Vec3&) {
        sum += omega.col(j).norm() * grad_W;
      });
      const Vec3 eta = disc.V * sum;
      const Vec3 omega_i = omega.col(i);
      const Real length = eta.norm();
      if (length * disc.h <= Real(1e-4) * omega_i.norm()) return;
      v.col(i) += dt * strength * (eta / length).cross(omega_i);
    });
  });
}

}  // namespace pbf
