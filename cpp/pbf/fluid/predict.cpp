#include "pbf/fluid/predict.hpp"

#include "pbf/core/parallel.hpp"

namespace pbf {

void predict(const PointsView& x,
             const PointsView& v,
             const Discretization& disc,
             Real dt,
             int threads,
             Points& x_star,
             Points& u) {
  x_star.resize(3, x.cols());
  u.resize(3, x.cols());
  const Vec3 dv = dt * disc.fluid.gravity;
  parallel_for(x.cols(), threads, [&](Index i) {
    x_star.col(i) = x.col(i);
    u.col(i).setZero();
    disc.move(x.col(i), dt * (v.col(i) + dv), x_star.col(i), u.col(i));
  });
}

void update_velocity(const PointsView& u, Real dt, int threads, Points& v) {
  v.resize(3, u.cols());
  parallel_for(u.cols(), threads, [&](Index i) { v.col(i) = u.col(i) / dt; });
}

}  // namespace pbf
