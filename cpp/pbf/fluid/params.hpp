#pragma once

#include "pbf/core/fields.hpp"
#include "pbf/kernels/kernel.hpp"

#include <optional>

namespace pbf {

/// What the fluid is. SI units.
struct FluidParams {
  Real spacing = 0.02F;
  std::optional<Real> support_radius = std::nullopt;
  Real rest_density = 1000.0F;
  Vec3 gravity{0.0F, -9.81F, 0.0F};
  std::optional<KernelChoice> kernel = std::nullopt;
  int dimensions = 3;

  /// The support radius h in force [m].
  [[nodiscard]] Real h() const { return support_radius.value_or(2.0F * spacing); }
  /// That of the paper where nobody has chosen; Simulation chooses by the solver's method.
  [[nodiscard]] KernelChoice kernel_in_force() const {
    return kernel.value_or(KernelChoice::poly6_spiky);
  }

  static constexpr const char* kName = "FluidParams";
  static auto fields() {
    return std::tuple{
        Field{"spacing", &FluidParams::spacing, "m", inside(1e-6, 1e6),
              "Particle distance at rest. Halving it makes eight times the particles and finer "
              "splashes."},
        Field{"support_radius", &FluidParams::support_radius, "m", above(0),
              "Kernel support radius h, 2 * spacing if not given. Larger is smoother, slower and "
              "rounder."},
        Field{"rest_density", &FluidParams::rest_density, "kg/m^3", inside(0, 1e12),
              "Density at rest. Scales masses, densities and pressures; the motion does not depend "
              "on it."},
        Field{"gravity", &FluidParams::gravity, "m/s^2", between(-1e6, 1e6),
              "Acceleration of every particle."},
        Field{
            "kernel", &FluidParams::kernel, "", anything(),
            "poly6_spiky: poly6 for densities, spiky for gradients, as in the paper; together "
            "they are no gradient of one thing, and fluid at rest simmers. cubic_spline, wendland: "
            "one kernel for both; it comes to rest. wendland if not given, poly6_spiky with the "
            "plain method."},
        Field{
            "dimensions", &FluidParams::dimensions, "", between(2, 3),
            "3: the fluid fills space. 2: it flows in a plane of constant z, with the kernels and "
            "the rest lattice of the plane; z of the gravity must be 0, and the domain has walls "
            "in x and y only."},
    };
  }
  void check_together(Faults& faults) const;
};

/// How multipliers come about.
enum class Method { plain, pressure };
template <>
struct Choices<Method> {
  static constexpr std::array names{"plain", "pressure"};
};

/// What speeds up the iterations.
enum class Acceleration { none, nesterov };
template <>
struct Choices<Acceleration> {
  static constexpr std::array names{"none", "nesterov"};
};

/// Where the length of a time step comes from.
enum class TimeStep { fixed, adaptive };
template <>
struct Choices<TimeStep> {
  static constexpr std::array names{"fixed", "adaptive"};
};

/// How the constraint is solved. The pure numbers mean the same at every resolution.
struct SolverParams {
  std::optional<Method> method = std::nullopt;
  std::optional<int> iterations = std::nullopt;
  int min_iterations = 2;
  int max_iterations = 100;
  Real tolerance = 0.001F;
  Real max_tolerance = 0.03F;
  Real compliance = 0.0F;
  Real warm_start = 0.25F;
  int levels = 2;
  Acceleration acceleration = Acceleration::nesterov;
  int substeps = 4;
  TimeStep time_step = TimeStep::fixed;
  Real cfl = 0.4F;
  Real min_time_step = 1e-4F;
  Real max_time_step = 5e-3F;
  Real relaxation = 0.01F;
  std::optional<Real> constraint_floor = std::nullopt;
  Real tensile_strength = 0.02F;
  Real tensile_distance = 0.2F;
  int tensile_exponent = 4;
  Real vorticity = 0.0F;
  Real xsph = 0.01F;
  int num_threads = 0;

  /// Counting iterations is the paper's way.
  [[nodiscard]] Method method_in_force() const {
    return method.value_or(iterations ? Method::plain : Method::pressure);
  }

  /// Exactly so many with the plain method or if they are given, else the most.
  [[nodiscard]] int iterations_in_force() const {
    return iterations.value_or(method_in_force() == Method::plain ? 4 : max_iterations);
  }
  /// A sum of iterations needs no pull: what pushed too far is taken back.
  [[nodiscard]] Real constraint_floor_in_force() const {
    return constraint_floor.value_or(method_in_force() == Method::plain ? -0.002F : 0.0F);
  }

  static constexpr const char* kName = "SolverParams";
  static auto fields() {
    return std::tuple{
        Field{"method", &SolverParams::method, "", anything(),
              "plain: every iteration starts from nothing, as in the paper; cheap, and springy "
              "where water is deep. pressure: multipliers add up over a time step, a bound keeps "
              "them from pulling, and the last step's are a first guess; it holds tall columns. "
              "plain if iterations are given, else pressure."},
        Field{"iterations", &SolverParams::iterations, "", between(1, 1000),
              "Solver iterations per time step, exactly. More make the fluid stiffer; a correction "
              "travels at most two support radii in each. If not given: 4 with the plain method, "
              "as many as the tolerances ask for with pressure."},
        Field{"min_iterations", &SolverParams::min_iterations, "", between(1, 1000),
              "Fewest iterations before tolerances are looked at."},
        Field{"max_iterations", &SolverParams::max_iterations, "", between(1, 10000),
              "Most iterations, tolerances met or not."},
        Field{
            "tolerance", &SolverParams::tolerance, "", inside(0, 1),
            "Mean compression, max(density / rest_density - 1, 0), at which the iterations end. "
            "Smaller is stiffer and slower. With compliance: what is left of the compression that "
            "the pressure does not account for."},
        Field{"max_tolerance", &SolverParams::max_tolerance, "", inside(0, 100),
              "Compression of the worst particle that must be reached as well. Iterations are for "
              "all particles, so a small one is dear. Near 100 the mean alone decides."},
        Field{"compliance", &SolverParams::compliance, "s^2/m^2", between(0, 1e6),
              "Softness of the fluid: density / rest_density - 1 = compliance * pressure / "
              "rest_density, whatever the time step. One over the speed of sound squared; 0 is "
              "incompressible. Pressure method."},
        Field{"warm_start", &SolverParams::warm_start, "", between(0, 1),
              "Share of the last time step's pressure that the iterations start from. More needs "
              "fewer iterations in calm water; near 1 errors live on and waves build up. Less in "
              "long steps, where it would push by more than half a squared spacing. Pressure "
              "method."},
        Field{"levels", &SolverParams::levels, "", between(1, 2),
              "2: in the first iteration of a step, a grid of cells six spacings wide solves for "
              "what is wrong over the height of the water, so that few iterations hold deep water. "
              "1: particles only, as in space without walls. Pressure method."},
        Field{"acceleration", &SolverParams::acceleration, "", anything(),
              "nesterov: iterations gather momentum, and need the root of the number that none "
              "needs. Pressure method."},
        Field{
            "substeps", &SolverParams::substeps, "", between(1, 1000),
            "Time steps per frame where the time step is fixed. More make the fluid livelier, and "
            "with the plain method stiffer: compression falls with their square."},
        Field{
            "time_step", &SolverParams::time_step, "", anything(),
            "fixed: substeps equal parts of a frame. adaptive: as many equal parts as the fastest "
            "particle needs (cfl), found anew in each step."},
        Field{"cfl", &SolverParams::cfl, "", inside(0, 10),
              "Adaptive time step: how far the fastest particle may move in a step, as a share of "
              "the spacing."},
        Field{"min_time_step", &SolverParams::min_time_step, "s", above(1e-13),
              "Adaptive time step: never shorter than this, but for the last one of a frame."},
        Field{"max_time_step", &SolverParams::max_time_step, "s", above(1e-13),
              "Adaptive time step: never longer than this."},
        Field{"relaxation", &SolverParams::relaxation, "", at_least(0),
              "Added to the multiplier's denominator, as a share of its value on the rest lattice. "
              "Larger is softer and calmer. The paper's epsilon is relaxation * D_ideal."},
        Field{
            "constraint_floor", &SolverParams::constraint_floor, "", at_most_or_minus_infinity(0),
            "The constraint is never taken below this; with the pressure method, the sum of a "
            "step's iterations pulls no more than this asks for. 0 pushes only, so drops come off "
            "freely; -inf pulls as well and clumps at free surfaces. If not given: -0.002 with the "
            "plain method, 0 with pressure."},
        Field{"tensile_strength", &SolverParams::tensile_strength, "", between(0, 10),
              "Artificial repulsion between close particles, in units of 1 / D_ideal, in every "
              "iteration or, with the pressure method, once in a step. Spreads thin sheets and "
              "evens out spacing; too much inflates the fluid. The paper's k is tensile_strength / "
              "D_ideal."},
        Field{"tensile_distance", &SolverParams::tensile_distance, "h", inside(0, 1),
              "Distance at which the artificial repulsion has its nominal strength, as a share of "
              "h. At the rest distance it must not exceed what fluid compressed by 100 % has; 0.1 "
              "to 0.3 are usual."},
        Field{"tensile_exponent", &SolverParams::tensile_exponent, "", between(1, 16),
              "How steeply the artificial repulsion grows as particles close up."},
        Field{"vorticity", &SolverParams::vorticity, "m/s", at_least(0),
              "Vorticity confinement: feeds eddies that the method damps. Livelier, then noisy."},
        Field{"xsph", &SolverParams::xsph, "", between(0, 1),
              "Share of the mean neighboring velocity taken over in each step. More is syrupy and "
              "coherent."},
        Field{"num_threads", &SolverParams::num_threads, "", between(0, 256),
              "Threads, 0 for all. The result has the same bits for any number."},
    };
  }
  void check_together(Faults& faults) const;
};

}  // namespace pbf
