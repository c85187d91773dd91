#include "pbf/fluid/density_constraint.hpp"
#include "pbf/neighbors/reorder.hpp"

#include <doctest/doctest.h>

#include "samples.hpp"

namespace pbf {
namespace {

struct Cloud {
  Discretization disc;
  Records x;
  Neighborhood near;

  Cloud(const FluidParams& fluid, const Points& positions, const std::optional<Box>& box = {})
      : disc(fluid, box) {
    CellGrid grid;
    Records unsorted = records_of(positions);
    near.sort(unsorted, disc, 2, grid);
    x = records_of(gathered(positions, grid.order()));
    near.build(grid, disc, 2, x);
  }

  [[nodiscard]] Scalars densities() const {
    Records density;
    relative_densities(near, disc, x, 2, density);
    return scalars_of(density);
  }
  [[nodiscard]] Records multipliers(const SolverParams& solver) const {
    Records x_lambda;
    solve_multipliers(near, disc, solver, x, x_lambda);
    return x_lambda;
  }
  /// The first iteration's Δp.
  [[nodiscard]] Points corrections(const SolverParams& solver) const {
    Records moved(x.size()), dp(x.size());
    apply_corrections(near, disc, solver, multipliers(solver), x, moved, dp);
    return points_of(dp);
  }
};

const Vec3 kOrigin = Vec3::Zero();

}  // namespace

TEST_CASE(
    "density constraint: a lattice block that fills its tank is at rest, for each kernel and "
    "support") {
  for (const KernelChoice kernel :
       {KernelChoice::poly6_spiky, KernelChoice::cubic_spline, KernelChoice::wendland}) {
    for (const Real ratio : {1.5F, 2.0F, 2.5F, 3.0F}) {
      CAPTURE(ratio);
      const FluidParams fluid{.spacing = 0.05F, .support_radius = ratio * 0.05F, .kernel = kernel};
      const Box box{.lower = kOrigin, .upper = Vec3::Constant(0.5F)};
      Cloud cloud(fluid, block(box.lower, box.upper, 0.05F), box);
      const Scalars lambda = scalars_of(cloud.multipliers({}));
      CHECK((cloud.densities() - 1).abs().maxCoeff() < 1e-4F);
      CHECK(lambda.abs().maxCoeff() * cloud.disc.ideal_denominator < 1e-4F);
    }
  }
}

TEST_CASE("density constraint: corrections of a free cloud add up to zero") {
  const FluidParams fluid{.spacing = 0.05F};
  Cloud cloud(fluid, samples::jittered_block(kOrigin, Vec3::Constant(0.6F), 0.05F, 0.4F));
  for (const Real floor : {0.0F, -std::numeric_limits<Real>::infinity()}) {
    const SolverParams solver{.constraint_floor = floor, .tensile_strength = 0.1F};
    const Points dp = cloud.corrections(solver);
    const double total = dp.cast<double>().rowwise().sum().norm();
    const double size = dp.cast<double>().colwise().norm().sum();
    REQUIRE(size > 0);
    CHECK(total <= 1e-6 * size);
  }
}

TEST_CASE("density constraint: iterations take compression away") {
  const FluidParams fluid{.spacing = 0.05F};
  const SolverParams solver{};
  Points x = samples::jittered_block(kOrigin, Vec3::Constant(0.5F), 0.05F, 0.1F) * 0.96F;
  Cloud cloud(fluid, x);
  const Records start = cloud.x;
  Records u(start.size());
  const Real before = (cloud.densities() - 1).max(0).mean();
  REQUIRE(before > 0.02F);
  for (int k = 0; k < 20; ++k) {
    apply_corrections(cloud.near, cloud.disc, solver, cloud.multipliers(solver), start, cloud.x, u);
  }
  CHECK((cloud.densities() - 1).max(0).mean() < 0.2F * before);
  const Points moved = points_of(cloud.x) - points_of(start);
  CHECK((points_of(u) - moved).cwiseAbs().maxCoeff() < 1e-6F);  // 20 roundings of 0.5 m
}

TEST_CASE("density constraint: the result does not change with the unit of length") {
  const auto shares = [](Real spacing) {
    const FluidParams fluid{.spacing = spacing};
    Cloud cloud(fluid,
                samples::jittered_block(kOrigin, Vec3::Constant(8 * spacing), spacing, 0.3F));
    const SolverParams solver{.relaxation = 0.05F, .tensile_strength = 0.1F};
    return Points(cloud.corrections(solver) / spacing);
  };
  // Powers of two, so that float32 rounds alike and the comparison can be tight.
  CHECK((shares(0.0625F) - shares(4.0F)).cwiseAbs().maxCoeff() < 1e-4F);
}

}  // namespace pbf
