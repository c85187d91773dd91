#include "pbf/fluid/predict.hpp"

#include "pbf/core/parallel.hpp"

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
  parallel_for(x.size(), threads, [&](Index i) {
    const Vec3 x_i{x[i].x, x[i].y, x[i].z}, v_i{v[i].x, v[i].y, v[i].z};
    const Vec3 u_i = dt * (v_i + dv);
    const Vec3 moved = x_i + u_i;
    const Vec3 allowed = disc.project(moved);
    // A wall leaves the way to it; elsewhere the difference of positions would bring in their
    // rounding.
    const auto way = [&](int axis) {
      return allowed[axis] == moved[axis] ? u_i[axis] : allowed[axis] - x_i[axis];
    };
    x_star[i] = {allowed[0], allowed[1], allowed[2], x[i].w};
    u[i] = {way(0), way(1), way(2), 0};
  });
}

void update_velocity(const Records& u, Real dt, int threads, Records& v) {
  v.resize(u.size());
  parallel_for(u.size(), threads, [&](Index i) {
    v[i] = {u[i].x / dt, u[i].y / dt, u[i].z / dt, v[i].w};
  });
}

}  // namespace pbf
