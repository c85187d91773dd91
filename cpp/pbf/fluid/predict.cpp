#include "pbf/fluid/predict.hpp"

#include "pbf/core/parallel.hpp"

#include <limits>

namespace pbf {

Prediction::Prediction(const Discretization& disc, Real dt) : dt_{dt, dt, dt, 0} {
  constexpr Real infinity = std::numeric_limits<Real>::infinity();
  const auto numbers = [](const Vec3& a, Real w) { return Numbers{a[0], a[1], a[2], w}; };
  const Vec3 none = Vec3::Constant(infinity);
  dv_ = numbers(dt * disc.fluid.gravity, 0);
  lower_ = numbers(disc.centers ? disc.centers->lower : Vec3(-none), -infinity);
  upper_ = numbers(disc.centers ? disc.centers->upper : none, infinity);
}

void predict(const Records& x,
             const Records& v,
             const Discretization& disc,
             Real dt,
             int threads,
             Records& x_star,
             Records& u) {
  x_star.resize(x.size());
  u.resize(x.size());
  const Prediction prediction(disc, dt);
  parallel_for(x.size(), threads, [&](Index i) { prediction(x[i], v[i], x_star[i], u[i]); });
  wrap(disc.domain, x_star, threads);
}

void update_velocity(
    const Records& u, Real dt, int threads, Records& v, std::vector<Real>& totals) {
  v.resize(u.size());
  totals.resize(static_cast<std::size_t>(u.size()));
  parallel_for(u.size(), threads, [&](Index i) {
    v[i] = {u[i].x / dt, u[i].y / dt, u[i].z / dt, v[i].w};
    totals[static_cast<std::size_t>(i)] = u[i].w;
  });
}

}  // namespace pbf
