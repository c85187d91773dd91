#pragma once

#include "pbf/fluid/discretization.hpp"
#include "pbf/fluid/pressure.hpp"
#include "pbf/fluid/state.hpp"
#include "pbf/fluid/step_report.hpp"

#include <functional>
#include <optional>
#include <vector>

namespace pbf {

/// Position Based Fluids: particles in, time steps, particles out. Every array that leaves is in
/// order of ids, the order in which particles were added; inside they are sorted by cell. Not for
/// several threads at once.
class Simulation {
 public:
  /// Throws InvalidParameter for parameters that break a rule. Without a domain space is open.
  explicit Simulation(const FluidParams& fluid,
                      const SolverParams& solver = {},
                      const std::optional<Box>& domain = {});

  /// Copies particles in, at rest if no velocities are given; on the upper face of a periodic axis,
  /// which is the lower one, they come to lie on that. Returns their ids, consecutive numbers.
  /// Throws InvalidParameter if a value is not finite, a position outside the domain or beyond what
  /// CellGrid reaches, in 2-D also outside the plane of the first particle, or a velocity out of
  /// that plane, or if the counts differ.
  Ids add_particles(const PointsView& positions, const std::optional<Points>& velocities = {});

  /// One time step of dt seconds: Algorithm 1 of [MM13]. Throws InvalidParameter unless dt is
  /// finite and at least 1e-15, and SimulationFailed if positions stop being finite or particles
  /// pile up; the state is then that before the call, to the bits of the steps that follow.
  StepReport step(Real dt);

  /// One frame of `seconds`, in solver().substeps steps, or in as many as an adaptive time step
  /// makes of it. `between_steps` is called after each; what it throws ends the frame there.
  StepReport advance(Real seconds, const std::function<void()>& between_steps = {});

  [[nodiscard]] Index size() const { return state_.x.size(); }
  [[nodiscard]] double time() const { return time_; }
  [[nodiscard]] std::int64_t step_count() const { return step_count_; }
  [[nodiscard]] const FluidParams& fluid() const { return disc_.fluid; }
  [[nodiscard]] const SolverParams& solver() const { return solver_; }
  [[nodiscard]] const std::optional<Box>& domain() const { return disc_.domain; }

  [[nodiscard]] Points positions() const;   ///< along periodic axes in [lower, upper) [m]
  [[nodiscard]] Points velocities() const;  ///< [m/s]
  [[nodiscard]] Scalars densities() const;  ///< ρ_i at these positions [kg/m³]
  [[nodiscard]] Scalars multipliers()
      const;  ///< λ_i of the last iteration [m²], zero before the first step
  [[nodiscard]] Scalars pressures()
      const;  ///< p_i of the last step (fluid/pressure.hpp) [Pa], zero before the first
  [[nodiscard]] Ids ids() const;
  /// Memory held, neighbor lists included [bytes].
  [[nodiscard]] std::size_t bytes() const;
  /// Of time, steps, ids, positions and velocities: equal for equal bits.
  [[nodiscard]] std::uint64_t state_hash() const;

  void set_solver(const SolverParams& solver);

 private:
  void sort_by_cell(Real dt);
  void unsort();
  void step_sorted(Real dt, StepReport& report);
  void iterate_plain(StepReport& report);
  void iterate_pressure(Real dt, StepReport& report);
  void measure(StepReport& report);
  template <class F>
  [[nodiscard]] Scalars found_anew(Real factor, F&& f) const;
  [[nodiscard]] Real cfl_time_step() const;

  Discretization disc_;
  SolverParams solver_;
  double time_ = 0;
  std::int64_t step_count_ = 0;

  State state_;
  Real last_dt_ = 0;  // of the step that totals belong to [s]

  // Of the step under way; x_star_ and v_new_ are swapped with the state when it has succeeded.
  Records x_star_, v_new_;
  Records u_;         // (x* − x, Λ); once velocities are known, scratch
  Records x_lambda_;  // (x*, λ) in the iterations, scratch before and after
  std::vector<std::uint32_t> sorted_ids_;
  std::vector<Real> new_totals_;
  PressureSolve pressure_;
  CellGrid grid_;
  Neighborhood near_;
};

}  // namespace pbf
