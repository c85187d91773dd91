#include "pbf/fluid/pressure.hpp"

#include "pbf/fluid/sweep.hpp"

#include <algorithm>
#include <cmath>

namespace pbf {
namespace {

/// A particle with less than this share of the rest density had little that could press on it.
constexpr Real kFreeDensity = 0.9F;

/// Largest |Λ| that a step starts from, in squared spacings.
constexpr Real kMostWarmPush = 0.5F;

}  // namespace

PressureErrors& PressureErrors::operator+=(const PressureErrors& other) {
  sum += other.sum;
  max = std::max(max, other.max);
  uphill += other.uphill;
  return *this;
}

void virial_pressures(const Neighborhood& near,
                      const Discretization& disc,
                      const Records& x_p,
                      int threads,
                      Records& p) {
  p.resize(x_p.size());
  sweep(near, disc, threads, [&](const auto& loops, const auto& VW, const Stretch& at) {
    loops.virials(VW, at, x_p.data(), p.data());
  });
  const Real share = 0.5F / static_cast<Real>(disc.fluid.dimensions);
  parallel_for(p.size(), threads, [&](Index i) { p[i].w *= share; });
}

void PressureSolve::begin(const Neighborhood& near,
                          const Discretization& disc,
                          const SolverParams& solver,
                          const Records& x_star,
                          const Records& v_density,
                          const std::vector<Real>& totals,
                          Real dt,
                          Real last_dt,
                          Records& x_delta) {
  const int threads = solver.num_threads;
  t_ = 1;
  states_.resize(near.fluid.size());
  x_delta.resize(x_star.size());
  // p = −ρ0 Λ/Δt² stays.
  const Real scale = last_dt > 0 ? solver.warm_start * square(dt / last_dt) : 0;
  const auto start = [&](Index i) {
    return v_density[i].w < kFreeDensity ? 0 : scale * totals[static_cast<std::size_t>(i)];
  };
  const Real largest =
      parallel_max(states_.size(), threads, [&](Index i) { return std::abs(start(i)); });
  const Real most = kMostWarmPush * square(disc.fluid.spacing);
  const Real share = largest > most ? most / largest : 1;
  parallel_for(states_.size(), threads, [&](Index i) {
    const Real total = share * start(i);
    states_[i] = {total, total, 0, 0};
    const Record& x = x_star[i];
    x_delta[i] = {x.x, x.y, x.z, total};
  });
  near.ghosts.refresh_positions(x_delta, threads);
}

PressureErrors PressureSolve::iterate(const Neighborhood& near,
                                      const Discretization& disc,
                                      const SolverParams& solver,
                                      Real dt,
                                      const Records& x_star,
                                      Records& x_delta) {
  const double next_t = (1 + std::sqrt(1 + 4 * t_ * t_)) / 2;
  const bool nesterov = solver.acceleration == Acceleration::nesterov;
  const PressureTerms terms{
      .epsilon = solver.relaxation * disc.ideal_denominator,
      .floor = solver.constraint_floor_in_force(),
      .compliance = solver.compliance / (dt * dt),
      .step = 1 / disc.largest_eigenvalue,
      .momentum = nesterov ? static_cast<Real>((t_ - 1) / next_t) : 0,
  };
  sweep(near, disc, solver.num_threads, [&](const auto& loops, const auto& VW, const Stretch& at) {
    loops.pressures(VW, at, terms, x_star.data(), states_.data(), x_delta.data());
  });
  near.ghosts.refresh_positions(x_delta, solver.num_threads);
  const auto errors =
      parallel_sum<PressureErrors>(states_.size(), solver.num_threads, [&](Index i) {
        const auto r = static_cast<double>(std::max(states_[i].z, Real(0)));
        return PressureErrors{r, r, static_cast<double>(states_[i].w)};
      });
  t_ = errors.uphill > 0 ? 1 : next_t;
  return errors;
}

void PressureSolve::correct_coarse(const Neighborhood& near,
                                   const Discretization& disc,
                                   const SolverParams& solver,
                                   Real dt,
                                   const Records& x_star,
                                   Records& x_delta) {
  coarse_.correct(near, disc, solver.compliance / (dt * dt), solver.num_threads, x_star, states_,
                  x_delta);
}

}  // namespace pbf
