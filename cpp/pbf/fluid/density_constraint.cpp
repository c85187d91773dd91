#include "pbf/fluid/density_constraint.hpp"

#include "pbf/fluid/sweep.hpp"

#include <limits>

namespace pbf {
namespace {

Bounds3 bounds_of(const std::optional<Box>& centers) {
  constexpr Real infinity = std::numeric_limits<Real>::infinity();
  if (!centers) return {{-infinity, -infinity, -infinity}, {infinity, infinity, infinity}};
  const Vec3 &lower = centers->lower, &upper = centers->upper;
  return {{lower[0], lower[1], lower[2]}, {upper[0], upper[1], upper[2]}};
}

template <class Kernel>
TensileTerms tensile_terms(const Kernel& VW,
                           const Discretization& disc,
                           const SolverParams& solver) {
  const Real dq = solver.tensile_distance * disc.h;
  return {solver.tensile_strength / disc.ideal_denominator, 1 / VW.W(dq * dq),
          solver.tensile_exponent};
}

}  // namespace

void relative_densities(const Neighborhood& near,
                        const Discretization& disc,
                        const Records& x,
                        int threads,
                        Records& density) {
  density.resize(x.size());
  sweep(near, disc, threads, [&](const auto& loops, const auto& VW, const Stretch& at) {
    loops.densities(VW, at, x.data(), density.data());
  });
}

void solve_multipliers(const Neighborhood& near,
                       const Discretization& disc,
                       const SolverParams& solver,
                       const Records& x_star,
                       Records& x_lambda) {
  x_lambda.resize(x_star.size());
  const Real epsilon = solver.relaxation * disc.ideal_denominator;
  sweep(near, disc, solver.num_threads, [&](const auto& loops, const auto& VW, const Stretch& at) {
    loops.multipliers(VW, at, epsilon, solver.constraint_floor_in_force(), x_star.data(),
                      x_lambda.data());
  });
  near.ghosts.refresh_positions(x_lambda, solver.num_threads);
}

void apply_corrections(const Neighborhood& near,
                       const Discretization& disc,
                       const SolverParams& solver,
                       const Records& x_lambda,
                       const Records& x,
                       Records& x_star,
                       Records& u) {
  const Bounds3 centers = bounds_of(disc.centers);
  sweep(near, disc, solver.num_threads, [&](const auto& loops, const auto& VW, const Stretch& at) {
    loops.corrections(VW, at, tensile_terms(VW, disc, solver), centers, x_lambda.data(), x.data(),
                      x_star.data(), u.data());
  });
  near.ghosts.refresh_positions(x_star, solver.num_threads);
}

}  // namespace pbf
