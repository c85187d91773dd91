#include "pbf/core/error.hpp"
#include "pbf/fluid/simulation.hpp"

#include <doctest/doctest.h>

#include "samples.hpp"
#include <limits>

namespace pbf {
namespace {

Simulation dam_break(int threads, const Axes& periodic = {false, false, false}) {
  const Box box{.lower = {0, 0, 0}, .upper = {1.0F, 0.6F, 0.4F}, .periodic = periodic};
  Simulation sim({.spacing = 0.04F}, {.vorticity = 0.01F, .num_threads = threads}, box);
  sim.add_particles(block({0, 0, 0}, {0.4F, 0.4F, 0.4F}, 0.04F));
  return sim;
}

}  // namespace

TEST_CASE("simulation: the same bits for any number of threads") {
  for (const Axes& periodic : {Axes{false, false, false}, Axes{true, false, true}}) {
    CAPTURE(periodic[0]);
    const auto hash_after = [&](int threads) {
      Simulation sim = dam_break(threads, periodic);
      for (int k = 0; k < 30; ++k) sim.step(0.004F);
      return sim.state_hash();
    };
    const std::uint64_t one = hash_after(1);
    for (const int threads : {2, 3, 4, 7, 16}) {
      CAPTURE(threads);
      CHECK(hash_after(threads) == one);
    }
  }
}

TEST_CASE("simulation: a lone particle falls as its integrator says") {
  Simulation sim({.spacing = 0.1F});
  sim.add_particles(Points::Zero(3, 1));
  Real y = 0, v = 0;
  for (int k = 0; k < 20; ++k) {
    sim.step(0.01F);
    v += 0.01F * -9.81F;
    y += 0.01F * v;
  }
  CHECK(sim.positions()(1, 0) == doctest::Approx(y).epsilon(1e-5));
  CHECK(sim.time() == doctest::Approx(0.2));
}

TEST_CASE("simulation: rows stay with their particles while the inside is sorted") {
  Simulation sim = dam_break(2);
  const Points before = sim.positions();
  sim.step(0.001F);
  CHECK((sim.positions() - before).colwise().norm().maxCoeff() < 0.01F);
  const Ids ids = sim.add_particles(Points::Constant(3, 1, 0.3F));
  CHECK(ids[0] == before.cols());
  CHECK(sim.positions().col(ids[0]) == Vec3::Constant(0.3F));
}

TEST_CASE("simulation: a rejected call changes nothing") {
  Simulation sim = dam_break(2);
  sim.step(0.002F);
  const std::uint64_t hash = sim.state_hash();
  const Real nan = std::numeric_limits<Real>::quiet_NaN();
  CHECK_THROWS_AS(sim.step(0), InvalidParameter);
  CHECK_THROWS_AS(sim.step(-1), InvalidParameter);
  CHECK_THROWS_AS(sim.step(nan), InvalidParameter);
  CHECK_THROWS_AS(sim.advance(nan), InvalidParameter);
  CHECK_THROWS_AS(sim.add_particles(Points::Constant(3, 1, nan)), InvalidParameter);
  CHECK_THROWS_AS(sim.add_particles(Points::Constant(3, 1, 9)), InvalidParameter);
  CHECK_THROWS_AS(sim.add_particles(Points::Zero(3, 2), Points(Points::Zero(3, 1))),
                  InvalidParameter);
  CHECK_THROWS_AS(sim.set_solver({.iterations = 0}), InvalidParameter);
  CHECK(sim.state_hash() == hash);
}

TEST_CASE("simulation: a step that fails leaves the last good state") {
  Simulation sim({.spacing = 0.1F, .gravity = {0, 0, 0}});
  Points v = Points::Zero(3, 2);
  v(0, 1) = 3e38F;
  Points x = Points::Zero(3, 2);
  x(0, 1) = 1;
  sim.add_particles(x, v);
  const std::uint64_t hash = sim.state_hash();
  CHECK_THROWS_AS(sim.step(10), SimulationFailed);
  CHECK(sim.state_hash() == hash);
  CHECK(sim.step_count() == 0);
}

TEST_CASE("simulation: without particles time passes") {
  Simulation sim({});
  const StepReport report = sim.step(0.01F);
  CHECK(report.max_density_error == 0);
  CHECK(sim.time() == doctest::Approx(0.01));
  CHECK(sim.densities().size() == 0);
}

TEST_CASE("simulation: the report counts iterations and times every stage that ran") {
  Simulation sim = dam_break(1);
  const StepReport report = sim.advance(1.0F / 60);
  CHECK(report.steps == sim.solver().substeps);
  CHECK(report.iterations >= sim.solver().substeps * sim.solver().min_iterations);
  for (const double ms : report.milliseconds) CHECK(ms > 0);
  CHECK(report.max_density_error >= report.mean_density_error);
}

TEST_CASE("simulation: a domain thinner than a particle is refused") {
  const Box thin{.lower = {0, 0, 0}, .upper = {1, 0.01F, 1}};
  CHECK_THROWS_AS(Simulation({.spacing = 0.02F}, {}, thin), InvalidParameter);
}

}  // namespace pbf
