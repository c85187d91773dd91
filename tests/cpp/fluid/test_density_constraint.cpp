#include "pbf/fluid/density_constraint.hpp"

#include <doctest/doctest.h>

#include "samples.hpp"

namespace pbf {
namespace {

struct Cloud {
  Discretization disc;
  CellGrid grid;
  Points x;
  Neighborhood near;

  Cloud(const FluidParams& fluid, const Points& positions, const std::optional<Box>& box = {})
      : disc(fluid, box), x(3, positions.cols()) {
    grid.build(positions, disc.h, 2);
    for (Index k = 0; k < x.cols(); ++k)
      x.col(k) = positions.col(grid.order()[static_cast<std::size_t>(k)]);
    near.fluid.build(grid, x, disc.h, 2);
    near.boundary.build(disc.walls, x, 2);
  }
};

const Vec3 kOrigin = Vec3::Zero();

}  // namespace

TEST_CASE(
    "density constraint: a lattice block that fills its tank is at rest, for each kernel and "
    "support") {
  for (const KernelChoice kernel : {KernelChoice::poly6_spiky, KernelChoice::cubic_spline}) {
    for (const Real ratio : {1.5F, 2.0F, 2.5F, 3.0F}) {
      CAPTURE(ratio);
      const FluidParams fluid{.spacing = 0.05F, .support_radius = ratio * 0.05F, .kernel = kernel};
      const Box box{.lower = kOrigin, .upper = Vec3::Constant(0.5F)};
      Cloud cloud(fluid, block(box.lower, box.upper, 0.05F), box);
      Scalars density, lambda;
      solve_multipliers(cloud.near, cloud.disc, {}, cloud.x, density, lambda);
      CHECK((density - 1).abs().maxCoeff() < 1e-4F);
      CHECK(lambda.abs().maxCoeff() * cloud.disc.ideal_denominator < 1e-4F);
    }
  }
}

TEST_CASE("density constraint: corrections of a free cloud add up to zero") {
  const FluidParams fluid{.spacing = 0.05F};
  Cloud cloud(fluid, samples::jittered_block(kOrigin, Vec3::Constant(0.6F), 0.05F, 0.4F));
  for (const Real floor : {0.0F, -std::numeric_limits<Real>::infinity()}) {
    const SolverParams solver{.constraint_floor = floor, .tensile_strength = 0.1F};
    Scalars density, lambda;
    Points dp;
    solve_multipliers(cloud.near, cloud.disc, solver, cloud.x, density, lambda);
    compute_corrections(cloud.near, cloud.disc, solver, cloud.x, lambda, dp);
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
  Scalars density, lambda;
  const Points start = cloud.x;
  Points dp, u = Points::Zero(3, start.cols());
  solve_multipliers(cloud.near, cloud.disc, solver, cloud.x, density, lambda);
  const Real before = (density - 1).max(0).mean();
  REQUIRE(before > 0.02F);
  for (int k = 0; k < 20; ++k) {
    solve_multipliers(cloud.near, cloud.disc, solver, cloud.x, density, lambda);
    compute_corrections(cloud.near, cloud.disc, solver, cloud.x, lambda, dp);
    apply_corrections(cloud.disc, start, dp, 2, cloud.x, u);
  }
  relative_densities(cloud.near, cloud.disc, cloud.x, 2, density);
  CHECK((density - 1).max(0).mean() < 0.2F * before);
  CHECK((u - (cloud.x - start)).cwiseAbs().maxCoeff() < 1e-6F);  // 20 roundings of 0.5 m
}

TEST_CASE("density constraint: the result does not change with the unit of length") {
  const auto shares = [](Real spacing) {
    const FluidParams fluid{.spacing = spacing};
    Cloud cloud(fluid,
                samples::jittered_block(kOrigin, Vec3::Constant(8 * spacing), spacing, 0.3F));
    const SolverParams solver{.relaxation = 0.05F, .tensile_strength = 0.1F};
    Scalars density, lambda;
    Points dp;
    solve_multipliers(cloud.near, cloud.disc, solver, cloud.x, density, lambda);
    compute_corrections(cloud.near, cloud.disc, solver, cloud.x, lambda, dp);
    return Points(dp / spacing);
  };
  // Powers of two, so that float32 rounds alike and the comparison can be tight.
  CHECK((shares(0.0625F) - shares(4.0F)).cwiseAbs().maxCoeff() < 1e-4F);
}

}  // namespace pbf
