#include "pbf/fluid/density_constraint.hpp"

#include "pbf/fluid/sweep.hpp"

#include <cmath>
#include <limits>
#include <type_traits>

namespace pbf {
namespace {

Bounds3 bounds_of(const std::optional<Box>& centers) {
  constexpr Real infinity = std::numeric_limits<Real>::infinity();
  if (!centers) return {{-infinity, -infinity, -infinity}, {infinity, infinity, infinity}};
  const Vec3 &lower = centers->lower, &upper = centers->upper;
  return {{lower[0], lower[1], lower[2]}, {upper[0], upper[1], upper[2]}};
}

template <class Kernel>
TensileTerms<Kernel> tensile_terms(const Discretization& disc, const SolverParams& solver) {
  const int dimensions = disc.fluid.dimensions;
  const Real dq = solver.tensile_distance * disc.h;
  const Real W_dq = Kernel(disc.h, 1, dimensions).W(dq * dq);
  const Real k = solver.tensile_strength / disc.ideal_denominator;
  const Real root = std::pow(k, 1 / static_cast<Real>(solver.tensile_exponent));
  return {Kernel(disc.h, root / W_dq, dimensions), k > 0 ? solver.tensile_exponent : 0};
}

}  // namespace

void require_moderate_repulsion(const Discretization& disc, const SolverParams& solver) {
  if (solver.tensile_strength == 0) return;
  const Real dq = solver.tensile_distance * disc.h, d = disc.fluid.spacing;
  const Real ratio = with_kernel(disc.fluid.kernel_in_force(), disc.fluid.dimensions, disc.h,
                                 [&](const auto& W) { return W.W(d * d) / W.W(dq * dq); });
  const Real repulsion = solver.tensile_strength *
                         std::pow(ratio, static_cast<Real>(solver.tensile_exponent));  // s D_ideal
  if (repulsion <= 1) return;
  throw InvalidParameter(
      "SolverParams.tensile_distance = " + to_text(solver.tensile_distance) +
      " h: with tensile_strength = " + to_text(solver.tensile_strength) +
      " and tensile_exponent = " + to_text(solver.tensile_exponent) +
      " fluid at rest would repel itself like fluid compressed by " + to_text(100 * repulsion) +
      " %; must be at most 100 %: a smaller distance, 0.1 to 0.3 h, a lower strength or a lower "
      "exponent");
}

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
    const auto tensile = tensile_terms<std::decay_t<decltype(VW)>>(disc, solver);
    loops.corrections(VW, at, tensile, centers, x_lambda.data(), x.data(), x_star.data(), u.data());
  });
  near.ghosts.refresh_positions(x_star, solver.num_threads);
}

}  // namespace pbf
