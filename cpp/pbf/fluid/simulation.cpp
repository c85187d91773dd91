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
#include <utility>

namespace pbf {
namespace {

std::string particle_text(const PointsView& points, Index i) {
  return "particle " + std::to_string(i) + " at " + to_text(Vec3(points.col(i)));
}

/// to[k] = from[order[k]]
template <class Array>
void gather(const Array& from, const std::vector<std::uint32_t>& order, int threads, Array& to) {
  to.resizeLike(from);
  parallel_for(static_cast<Index>(order.size()), threads,
               [&](Index k) { copy_particle(from, order[static_cast<std::size_t>(k)], to, k); });
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
    : disc_(fluid, domain) {
  set_solver(solver);
}

void Simulation::set_solver(const SolverParams& solver) {
  validate(solver);
  solver_ = solver;
}

Ids Simulation::add_particles(const PointsView& positions,
                              const std::optional<Points>& velocities) {
  const Index added = positions.cols();
  if (velocities && velocities->cols() != added) {
    throw InvalidParameter("velocities: " + std::to_string(velocities->cols()) +
                           " rows, but positions has " + std::to_string(added) + "; must be equal");
  }
  for (Index i = 0; i < added; ++i) {
    const Vec3 x = positions.col(i);
    if (!x.allFinite())
      throw InvalidParameter("positions: " + particle_text(positions, i) + " m; must be finite");
    if (velocities && !velocities->col(i).allFinite()) {
      throw InvalidParameter("velocities: " + particle_text(*velocities, i) +
                             " m/s; must be finite");
    }
    if (disc_.domain && !disc_.domain->contains(x)) {
      throw InvalidParameter("positions: " + particle_text(positions, i) +
                             " m is outside the domain; must be within " +
                             to_text(disc_.domain->lower) + " and " + to_text(disc_.domain->upper) +
                             " m");
    }
  }

  const Index before = size();
  Ids new_ids = consecutive(before, added);
  State state;
  state.x.resize(3, before + added);
  state.v.setZero(3, before + added);
  state.ids.resize(before + added);
  state.lambda.setZero(before + added);
  state.x.leftCols(before) = state_.x;
  state.v.leftCols(before) = state_.v;
  state.ids.head(before) = state_.ids;
  state.lambda.head(before) = state_.lambda;
  state.x.rightCols(added) = positions;
  if (velocities) state.v.rightCols(added) = *velocities;
  state.ids.tail(added) = new_ids;
  state_ = std::move(state);
  return new_ids;
}

StepReport Simulation::step(Real dt) {
  if (!(dt > 0) || !std::isfinite(dt)) {
    throw InvalidParameter("dt = " + to_text(dt) + " s: must be finite, > 0");
  }
  const int threads = solver_.num_threads;
  StepReport report;
  {
    const auto t = report.time(Stage::predict);
    predict(state_.x, state_.v, disc_, dt, threads, x_star_, u_);
  }
  {
    const auto t = report.time(Stage::neighbors);
    sort_by_cell();
    near_.fluid.build(grid_, x_star_, disc_.h, threads);
  }
  {
    const auto t = report.time(Stage::boundary);
    near_.boundary.build(disc_.walls, x_star_, threads);
  }
  for (int k = 0; k < solver_.iterations; ++k, ++report.iterations) {
    {
      const auto t = report.time(Stage::multipliers);
      solve_multipliers(near_, disc_, solver_, x_star_, relative_density_, lambda_new_);
    }
    {
      const auto t = report.time(Stage::corrections);
      compute_corrections(near_, disc_, solver_, x_star_, lambda_new_, dp_);
    }
    {
      const auto t = report.time(Stage::collision);
      apply_corrections(disc_, state_.x, dp_, threads, x_star_, u_);
    }
  }
  {
    const auto t = report.time(Stage::velocity);
    update_velocity(u_, dt, threads, v_new_);
  }
  if (solver_.vorticity > 0) {
    const auto t = report.time(Stage::vorticity);
    compute_vorticity(near_, disc_, x_star_, v_new_, threads, omega_);
    confine_vorticity(near_, disc_, x_star_, omega_, solver_.vorticity, dt, threads, v_new_);
  }
  if (solver_.xsph > 0) {
    const auto t = report.time(Stage::xsph);
    smooth_velocities(near_, disc_, x_star_, v_new_, solver_.xsph, threads, dp_);
    v_new_.swap(dp_);
  }
  {
    const auto t = report.time(Stage::density);
    measure(report);
  }
  state_.x.swap(x_star_);
  state_.v.swap(v_new_);
  state_.lambda.swap(lambda_new_);
  time_ += static_cast<double>(dt);
  ++step_count_;
  return report;
}

StepReport Simulation::advance(Real seconds, const std::function<void()>& between_steps) {
  if (!(seconds > 0) || !std::isfinite(seconds)) {
    throw InvalidParameter("seconds = " + to_text(seconds) + " s: must be finite, > 0");
  }
  const Real dt = seconds / static_cast<Real>(solver_.substeps);
  StepReport report = step(dt);
  for (int k = 1; k < solver_.substeps; ++k) {
    if (between_steps) between_steps();
    report.add(step(dt));
  }
  return report;
}

/// Sorts the state by the cells of x*. All copies are made before anything is swapped, and which
/// particle is which stays as it was: a step that fails here or later has changed nothing that can
/// be seen.
void Simulation::sort_by_cell() {
  const int threads = solver_.num_threads;
  grid_.build(x_star_, disc_.h, threads);
  gather(state_.x, grid_.order(), threads, sorted_.x);
  gather(state_.v, grid_.order(), threads, sorted_.v);
  gather(state_.ids, grid_.order(), threads, sorted_.ids);
  gather(state_.lambda, grid_.order(), threads, sorted_.lambda);
  gather(x_star_, grid_.order(), threads, dp_);
  gather(u_, grid_.order(), threads, omega_);
  state_.x.swap(sorted_.x);
  state_.v.swap(sorted_.v);
  state_.ids.swap(sorted_.ids);
  state_.lambda.swap(sorted_.lambda);
  x_star_.swap(dp_);
  u_.swap(omega_);
}

/// Density errors at the positions the step ends with; throws if any number is not finite.
void Simulation::measure(StepReport& report) {
  const Index n = x_star_.cols();
  if (n == 0) return;
  relative_densities(near_, disc_, x_star_, solver_.num_threads, relative_density_);
  const double broken = parallel_sum(n, solver_.num_threads, [&](Index i) {
    return x_star_.col(i).allFinite() && v_new_.col(i).allFinite() ? 0.0 : 1.0;
  });
  if (broken > 0) {
    throw SimulationFailed(
        "step " + std::to_string(step_count_ + 1) + ": " +
        std::to_string(static_cast<Index>(broken)) +
        " particles have positions or velocities that are not finite; use a smaller time step");
  }
  const double sum = parallel_sum(n, solver_.num_threads, [&](Index i) {
    return static_cast<double>(std::max(relative_density_[i] - 1, Real(0)));
  });
  report.mean_density_error = sum / static_cast<double>(n);
  report.max_density_error = std::max(0.0, static_cast<double>(relative_density_.maxCoeff()) - 1);
}

Points Simulation::positions() const { return scattered(state_.x, state_.ids); }
Points Simulation::velocities() const { return scattered(state_.v, state_.ids); }
Scalars Simulation::multipliers() const { return scattered(state_.lambda, state_.ids); }
Ids Simulation::ids() const { return consecutive(0, size()); }

Scalars Simulation::densities() const {
  // Found anew, since particles may have been added after the last step.
  const Points x = positions();
  const int threads = solver_.num_threads;
  CellGrid grid;
  grid.build(x, disc_.h, threads);
  const Points x_sorted = gathered(x, grid.order());
  Neighborhood near;
  near.fluid.build(grid, x_sorted, disc_.h, threads);
  near.boundary.build(disc_.walls, x_sorted, threads);
  Scalars sorted;
  relative_densities(near, disc_, x_sorted, threads, sorted);
  return disc_.fluid.rest_density * scattered(sorted, grid.order());
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
