#include "pbf/fluid/predict.hpp"

#include "pbf/core/parallel.hpp"

namespace pbf {

void predict(const PointsView& x,
             const PointsView& v,
             const Discretization& disc,
             Real dt,
             int threads,
             Points& x_star) {
  x_star.resize(3, x.cols());
  const Vec3 dv = dt * disc.fluid.gravity;
  parallel_for(x.cols(), threads, [&](Index i) {
    const Vec3 moved = x.col(i) + dt * (v.col(i) + dv);
    x_star.col(i) = disc.project(moved);
  });
}

void update_velocity(
    const PointsView& x, const PointsView& x_star, Real dt, int threads, Points& v) {
  v.resize(3, x.cols());
  parallel_for(x.cols(), threads, [&](Index i) { v.col(i) = (x_star.col(i) - x.col(i)) / dt; });
}

}  // namespace pbf
