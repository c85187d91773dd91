#include "pbf/fluid/predict.hpp"

#include "pbf/core/parallel.hpp"

#include <limits>

namespace pbf {

void predict(const Records& x,
             const Records& v,
             const Discretization& disc,
             Real dt,
             int threads,
             Records& x_star,
             Records& u) {
  x_star.resize(x.size());
  u.resize(x.size());
  const Vec3 dv = dt * disc.fluid.gravity;
  constexpr Real infinity = std::numeric_limits<Real>::infinity();
  const Box centers = disc.centers.value_or(
      Box{.lower = Vec3::Constant(-infinity), .upper = Vec3::Constant(infinity)});
  parallel_for(x.size(), threads, [&](Index i) {
    // A wall leaves the way to it; elsewhere the difference of positions would bring in their
    // rounding.
    const auto move = [&](Real from, Real velocity, int axis, Real& to, Real& way) {
      way = dt * (velocity + dv[axis]);
      const Real moved = from + way;
      to = centers.project(axis, moved);
      if (to != moved) way = to - from;
    };
    const Record &x_i = x[i], &v_i = v[i];
    Record to{.w = x_i.w}, way;
    move(x_i.x, v_i.x, 0, to.x, way.x);
    move(x_i.y, v_i.y, 1, to.y, way.y);
    move(x_i.z, v_i.z, 2, to.z, way.z);
    x_star[i] = to;
    u[i] = way;
  });
  wrap(disc.domain, x_star, threads);
}

void update_velocity(const Records& u, Real dt, int threads, Records& v) {
  v.resize(u.size());
  parallel_for(u.size(), threads, [&](Index i) {
    v[i] = {u[i].x / dt, u[i].y / dt, u[i].z / dt, v[i].w};
  });
}

}  // namespace pbf
