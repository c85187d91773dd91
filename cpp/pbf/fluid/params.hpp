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
  KernelChoice kernel = KernelChoice::poly6_spiky;
  int dimensions = 3;

  /// The support radius h in force [m].
  [[nodiscard]] Real h() const { return support_radius.value_or(2.0F * spacing); }

  static constexpr const char* kName = "FluidParams";
  static auto fields() {
    return std::tuple{
        Field{"spacing", &FluidParams::spacing, "m", inside(1e-6, 1e6),
              "Particle distance at rest. Halving it makes eight times the particles and finer "
              "splashes."},
        Field{"support_radius", &FluidParams::support_radius, "m", above(0),
              "Kernel support radius h, 2 * spacing if not given. Larger is smoother, slower and "
              "rounder."},
        Field{"rest_density", &FluidParams::rest_density, "kg/m^3", above(0),
              "Density at rest. Scales masses, densities and pressures; the motion does not depend "
              "on it."},
        Field{"gravity", &FluidParams::gravity, "m/s^2", between(-1e6, 1e6),
              "Acceleration of every particle."},
        Field{"kernel", &FluidParams::kernel, "", anything(),
              "poly6_spiky: poly6 for densities, spiky for gradients, as in the paper. "
              "cubic_spline: one kernel for both."},
        Field{
            "dimensions", &FluidParams::dimensions, "", between(2, 3),
            "3: the fluid fills space. 2: it flows in a plane of constant z, with the kernels and "
            "the rest lattice of the plane; z of the gravity must be 0, and the domain has walls "
            "in x and y only."},
    };
  }
  void check_together(Faults& faults) const;
};

/// How the constraint is solved. The pure numbers mean the same at every resolution.
struct SolverParams {
  int iterations = 4;
  int substeps = 4;
  Real relaxation = 0.01F;
  Real constraint_floor = -0.002F;
  Real tensile_strength = 0.02F;
  Real tensile_distance = 0.2F;
  int tensile_exponent = 4;
  Real vorticity = 0.0F;
  Real xsph = 0.01F;
  int num_threads = 0;

  static constexpr const char* kName = "SolverParams";
  static auto fields() {
    return std::tuple{
        Field{"iterations", &SolverParams::iterations, "", between(1, 1000),
              "Solver iterations per time step. More make the fluid stiffer; a correction travels "
              "at most "
              "two support radii in each."},
        Field{"substeps", &SolverParams::substeps, "", between(1, 1000),
              "Time steps per frame. More make the fluid stiffer and livelier: compression falls "
              "with their "
              "square."},
        Field{"relaxation", &SolverParams::relaxation, "", at_least(0),
              "Added to the multiplier's denominator, as a share of its value on the rest lattice. "
              "Larger is softer and calmer. The paper's epsilon is relaxation * D_ideal."},
        Field{"constraint_floor", &SolverParams::constraint_floor, "", at_most_or_minus_infinity(0),
              "The constraint is never taken below this. 0 pushes only, so drops come off freely; "
              "-inf pulls "
              "as well and clumps at free surfaces."},
        Field{"tensile_strength", &SolverParams::tensile_strength, "", between(0, 10),
              "Artificial repulsion between close particles, in units of 1 / D_ideal. Spreads thin "
              "sheets and "
              "evens out spacing; too much inflates the fluid. The paper's k is tensile_strength / "
              "D_ideal."},
        Field{"tensile_distance", &SolverParams::tensile_distance, "h", inside(0, 1),
              "Distance at which the artificial repulsion has its nominal strength, as a share of "
              "h."},
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
};

}  // namespace pbf
