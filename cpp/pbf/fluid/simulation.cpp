#include "pbf/fluid/simulation.hpp"

#include "pbf/core/hash.hpp"
#include "pbf/core/parallel.hpp"
#include "pbf/fluid/density_constraint.hpp"
#include "pbf/fluid/predict.hpp"
#include "pbf/fluid/vorticity.hpp"
#include "pbf/fluid/xsph.hpp"
#include "pbf/neighbors/reorder.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>

namespace pbf {
namespace {

/// Mean compression of what is no fluid any more.
constexpr double kCrushed = 1.0;

/// Shortest time step: with less, 1/dt² in pressures is more than a float holds. A frame may have a
/// thousand steps [s].
constexpr Real kShortestStep = 1e-15F;
constexpr Real kShortestFrame = 1000 * kShortestStep;

void require_time(const char* name, Real time, Real shortest) {
  if (!(time >= shortest) || !std::isfinite(time)) {
    throw InvalidParameter(std::string(name) + " = " + to_text(time) +
                           " s: " + at_least(static_cast<double>(shortest)).text());
  }
}

/// The kernel that the method is at its best with: pressures want one that both densities and
/// gradients come from, or fluid at rest is heated (docs/convergence.md).
FluidParams with_kernel_for(const SolverParams& solver, FluidParams fluid) {
  const bool plain = solver.method_in_force() == Method::plain;
  if (!fluid.kernel) fluid.kernel = plain ? KernelChoice::poly6_spiky : KernelChoice::wendland;
  return fluid;
}

Ids consecutive(std::int64_t first, Index count) {
  Ids ids(count);
  std::iota(ids.begin(), ids.end(), first);
  return ids;
}

}  // namespace

Simulation::Simulation(const FluidParams& fluid,
                       const SolverParams& solver,
                       const std::optional<Box>& domain)
    : disc_(with_kernel_for(solver, fluid), domain) {
  set_solver(solver);
}

void Simulation::set_solver(const SolverParams& solver) {
  validate(solver);
  require_moderate_repulsion(disc_, solver);
  solver_ = solver;
}

Ids Simulation::add_particles(const PointsView& positions,
                              const std::optional<Points>& velocities) {
  const Index before = size();
  state_ = with_particles(state_, positions, velocities, disc_);
  return consecutive(before, positions.cols());
}

StepReport Simulation::step(Real dt) {
  require_time("dt", dt, kShortestStep);
  const int threads = solver_.num_threads;
  StepReport report;
  {
    const auto t = report.time(Stage::predict);
    predict(state_.x, state_.v, disc_, dt, threads, x_star_, u_);
  }
  {
    const auto t = report.time(Stage::neighbors);
    sort_by_cell(dt);
  }
  try {
    step_sorted(dt, report);
  } catch (...) {
    unsort();
    throw;
  }
  // The ghosts' time is over.
  x_star_.resize(size());
  v_new_.resize(size());
  wrap(disc_.domain, x_star_, threads);
  state_.x.swap(x_star_);
  state_.v.swap(v_new_);
  state_.totals.swap(new_totals_);
  last_dt_ = dt;
  time_ += static_cast<double>(dt);
  ++step_count_;
  return report;
}

/// The step from the neighbor lists on: (x*, λ) and (v, ρ/ρ0) of its end.
void Simulation::step_sorted(Real dt, StepReport& report) {
  const int threads = solver_.num_threads;
  {
    const auto t = report.time(Stage::neighbors);
    near_.ghosts.refresh_positions(x_star_, threads);
    near_.fluid.build(grid_, x_star_, disc_.h, threads);
  }
  {
    const auto t = report.time(Stage::boundary);
    near_.boundary.build(disc_.walls, x_star_, size(), near_.fluid.lanes(), threads);
  }
  if (solver_.method_in_force() == Method::plain) {
    iterate_plain(report);
  } else {
    iterate_pressure(dt, report);
  }
  {
    const auto t = report.time(Stage::velocity);
    update_velocity(u_, dt, threads, v_new_, new_totals_);
    near_.ghosts.refresh(v_new_, threads);
  }
  if (solver_.vorticity > 0) {
    const auto t = report.time(Stage::vorticity);
    Records &omega = u_, &x_strength = x_lambda_;
    compute_vorticity(near_, disc_, x_star_, v_new_, threads, omega, x_strength);
    confine_vorticity(near_, disc_, x_strength, omega, solver_.vorticity, dt, threads, v_new_);
  }
  if (solver_.xsph > 0) {
    const auto t = report.time(Stage::xsph);
    smooth_velocities(near_, disc_, x_star_, v_new_, solver_.xsph, threads, u_);
    v_new_.swap(u_);
  } else {
    const auto t = report.time(Stage::density);
    relative_densities(near_, disc_, x_star_, threads, v_new_);
  }
  {
    const auto t = report.time(Stage::density);
    measure(report);
  }
}

void Simulation::iterate_plain(StepReport& report) {
  for (const int count = solver_.iterations_in_force(); report.iterations < count;
       ++report.iterations) {
    {
      const auto t = report.time(Stage::multipliers);
      solve_multipliers(near_, disc_, solver_, x_star_, x_lambda_);
    }
    {
      const auto t = report.time(Stage::corrections);
      apply_corrections(near_, disc_, solver_, x_lambda_, state_.x, x_star_, u_);
    }
  }
}

/// Artificial repulsion acts once, with the first corrections: in every iteration the multipliers
/// would only answer it, and never come to an end.
void Simulation::iterate_pressure(Real dt, StepReport& report) {
  SolverParams no_repulsion = solver_;
  no_repulsion.tensile_strength = 0;
  {
    const auto t = report.time(Stage::multipliers);
    pressure_.begin(near_, disc_, solver_, x_star_, state_.v, state_.totals, dt, last_dt_,
                    x_lambda_);
  }
  {
    const auto t = report.time(Stage::corrections);
    apply_corrections(near_, disc_, solver_, x_lambda_, state_.x, x_star_, u_);
  }
  const int most = solver_.iterations_in_force();
  const double enough = static_cast<double>(solver_.tolerance) * static_cast<double>(size());
  const double worst = static_cast<double>(solver_.max_tolerance);
  while (report.iterations < most) {
    {
      const auto t = report.time(Stage::multipliers);
      const PressureErrors errors =
          pressure_.iterate(near_, disc_, solver_, dt, x_star_, x_lambda_);
      const bool good = errors.sum <= enough && errors.max <= worst;
      if (good && !solver_.iterations && report.iterations >= solver_.min_iterations) return;
      if (solver_.levels > 1 && disc_.has_walls() && report.iterations == 0) {
        pressure_.correct_coarse(near_, disc_, solver_, dt, x_star_, x_lambda_);
      }
    }
    {
      const auto t = report.time(Stage::corrections);
      apply_corrections(near_, disc_, no_repulsion, x_lambda_, state_.x, x_star_, u_);
    }
    ++report.iterations;
  }
}

StepReport Simulation::advance(Real seconds, const std::function<void()>& between_steps) {
  require_time("seconds", seconds, kShortestFrame);
  if (solver_.time_step == TimeStep::fixed) {
    const Real dt = seconds / static_cast<Real>(solver_.substeps);
    StepReport report = step(dt);
    for (int k = 1; k < solver_.substeps; ++k) {
      if (between_steps) between_steps();
      report.add(step(dt));
    }
    return report;
  }
  std::optional<StepReport> report;
  for (double left = seconds; left > 1e-6 * seconds;) {
    if (report && between_steps) between_steps();
    // Equal parts of what is left: no short step at the end.
    const double parts = std::ceil(left / static_cast<double>(cfl_time_step()) - 1e-6);
    const auto dt = static_cast<Real>(left / std::max(parts, 1.0));
    const StepReport latest = step(dt);
    left -= static_cast<double>(dt);
    if (report) {
      report->add(latest);
    } else {
      report = latest;
    }
  }
  return *report;
}

/// The time in which the fastest particle, falling on, moves cfl spacings; within bounds.
Real Simulation::cfl_time_step() const {
  const Vec3 fall = solver_.max_time_step * disc_.fluid.gravity;
  const Real speed2 = parallel_max(size(), solver_.num_threads, [&](Index i) {
    return (vec3(state_.v[i]) + fall).squaredNorm();
  });
  const Real way = solver_.cfl * disc_.fluid.spacing;
  const Real longest = std::min(solver_.max_time_step, way / std::sqrt(speed2));
  return std::max(solver_.min_time_step, longest);
}

/// Sorts the state by the cells of x*, and predicts x* and u again, which is cheaper than to bring
/// them into the new order.
void Simulation::sort_by_cell(Real dt) {
  const int threads = solver_.num_threads;
  near_.sort(x_star_, disc_, threads, grid_);
  Records &x = x_lambda_, &v = v_new_;
  x.resize(size());
  v.resize(size());
  sorted_ids_.resize(state_.ids.size());
  new_totals_.resize(state_.totals.size());
  x_star_.resize(size());
  const Prediction prediction(disc_, dt);
  parallel_for(size(), threads, [&](Index k) {
    const std::uint32_t from = grid_.order()[static_cast<std::size_t>(k)];
    x[k] = state_.x[from];
    v[k] = state_.v[from];
    prediction(x[k], v[k], x_star_[k], u_[k]);
    sorted_ids_[static_cast<std::size_t>(k)] = state_.ids[from];
    new_totals_[static_cast<std::size_t>(k)] = state_.totals[from];
  });
  state_.x.swap(x);
  state_.v.swap(v);
  state_.ids.swap(sorted_ids_);
  state_.totals.swap(new_totals_);
  wrap(disc_.domain, x_star_, threads);
}

/// Undoes it after a step that failed: the order of particles is that of sums, so that of a state
/// in another order the same steps would have other bits.
void Simulation::unsort() {
  Records &x = x_lambda_, &v = v_new_;
  x.resize(size());
  v.resize(size());
  for (Index k = 0; k < size(); ++k) {
    const auto from = static_cast<std::size_t>(k);
    const std::uint32_t to = grid_.order()[from];
    x[to] = state_.x[k];
    v[to] = state_.v[k];
    sorted_ids_[to] = state_.ids[from];
    new_totals_[to] = state_.totals[from];
  }
  state_.x.swap(x);
  state_.v.swap(v);
  state_.ids.swap(sorted_ids_);
  state_.totals.swap(new_totals_);
}

/// Density errors at the positions the step ends with, from (v, ρ/ρ0); throws if any number is not
/// finite.
void Simulation::measure(StepReport& report) {
  const Index n = size();
  if (n == 0) return;
  struct Errors {
    double sum = 0, max = 0;
    Index broken = 0;
    Errors& operator+=(const Errors& other) {
      sum += other.sum;
      max = std::max(max, other.max);
      broken += other.broken;
      return *this;
    }
  };
  const auto total = parallel_sum<Errors>(n, solver_.num_threads, [&](Index i) {
    const Record &x = x_star_[i], &v = v_new_[i];
    const auto error = static_cast<double>(std::max(v.w - 1, Real(0)));
    return Errors{error, error, std::isfinite(x.x + x.y + x.z + v.x + v.y + v.z + v.w) ? 0 : 1};
  });
  if (total.broken > 0) {
    throw SimulationFailed(
        "step " + std::to_string(step_count_ + 1) + ": " + std::to_string(total.broken) +
        " particles have positions or velocities that are not finite; use a smaller time step");
  }
  report.mean_density_error = total.sum / static_cast<double>(n);
  report.max_density_error = total.max;
  report.stable = report.mean_density_error < kCrushed;
}

Points Simulation::positions() const { return scattered(points_of(state_.x), state_.ids); }
Points Simulation::velocities() const { return scattered(points_of(state_.v), state_.ids); }
Scalars Simulation::multipliers() const { return scattered(scalars_of(state_.x), state_.ids); }
Ids Simulation::ids() const { return consecutive(0, size()); }

/// What f(near, (x, Λ), result) leaves in the fourth numbers of result, by id. Who is near whom is
/// found anew, since particles may have been added after the last step.
template <class F>
Scalars Simulation::found_anew(Real factor, F&& f) const {
  CellGrid grid;
  Neighborhood near;
  Records unsorted = state_.x, x(size()), result;
  near.sort(unsorted, disc_, solver_.num_threads, grid);
  const auto order = std::span(grid.order()).first(static_cast<std::size_t>(size()));
  for (Index k = 0; k < size(); ++k) {
    const std::uint32_t from = order[static_cast<std::size_t>(k)];
    x[k] = state_.x[from];
    x[k].w = state_.totals[from];
  }
  near.build(grid, disc_, solver_.num_threads, x);
  f(near, x, result);
  result.resize(size());
  const Scalars in_state_order = scattered(scalars_of(result), order);
  return factor * scattered(in_state_order, state_.ids);
}

Scalars Simulation::densities() const {
  return found_anew(disc_.fluid.rest_density, [&](const auto& near, const auto& x, Records& rho) {
    relative_densities(near, disc_, x, solver_.num_threads, rho);
  });
}

Scalars Simulation::pressures() const {
  const Real per_multiplier = last_dt_ > 0 ? -disc_.fluid.rest_density / square(last_dt_) : 0;
  return found_anew(per_multiplier, [&](const auto& near, const auto& x_total, Records& p) {
    virial_pressures(near, disc_, x_total, solver_.num_threads, p);
  });
}

std::size_t Simulation::bytes() const {
  const auto n = static_cast<std::size_t>(size());
  const std::size_t records = 6 * n * sizeof(Record);
  return records + 2 * n * sizeof(std::uint32_t) + 2 * n * sizeof(Real) + pressure_.bytes() +
         grid_.bytes() + near_.fluid.bytes() + near_.boundary.bytes() + near_.ghosts.bytes();
}

std::uint64_t Simulation::state_hash() const {
  const Points x = positions(), v = velocities();
  const auto bytes = [](const Points& p) {
    return static_cast<std::size_t>(p.size()) * sizeof(Real);
  };
  return Hash()
      .add(&time_, sizeof time_)
      .add(&step_count_, sizeof step_count_)
      .add(x.data(), bytes(x))
      .add(v.data(), bytes(v))
      .value();
}

}  // namespace pbf
