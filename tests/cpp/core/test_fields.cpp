#include "pbf/boundary/box.hpp"
#include "pbf/core/fields.hpp"
#include "pbf/fluid/params.hpp"

#include <doctest/doctest.h>

#include <limits>
#include <string>

namespace pbf {
namespace {

template <class Params>
std::string fault_of(const Params& params) {
  try {
    validate(params);
  } catch (const InvalidParameter& e) {
    return e.what();
  }
  return "";
}

}  // namespace

TEST_CASE("fields: the defaults obey their own rules") {
  CHECK(fault_of(FluidParams{}).empty());
  CHECK(fault_of(SolverParams{}).empty());
  CHECK(fault_of(Box{}).empty());
}

TEST_CASE("fields: a fault names field, value, unit and rule") {
  FluidParams fluid;
  fluid.spacing = -0.02F;
  CHECK(fault_of(fluid).find("FluidParams.spacing = -0.02 m: must be finite, > 1e-06") == 0);
}

TEST_CASE("fields: all faults of a struct are told at once") {
  SolverParams solver;
  solver.iterations = 0;
  solver.xsph = std::numeric_limits<Real>::quiet_NaN();
  const std::string fault = fault_of(solver);
  CHECK(fault.find("SolverParams.iterations = 0") != std::string::npos);
  CHECK(fault.find("SolverParams.xsph = nan") != std::string::npos);
}

TEST_CASE("fields: minus infinity is a constraint floor, plus infinity is not a spacing") {
  SolverParams solver;
  solver.constraint_floor = -std::numeric_limits<Real>::infinity();
  CHECK(fault_of(solver).empty());
  FluidParams fluid;
  fluid.spacing = std::numeric_limits<Real>::infinity();
  CHECK_FALSE(fault_of(fluid).empty());
}

TEST_CASE("fields: rules across fields name the value in force") {
  FluidParams fluid;
  fluid.spacing = 0.1F;
  fluid.support_radius = 0.05F;
  CHECK(fault_of(fluid).find("FluidParams.support_radius = 0.05 m") == 0);
  Box box;
  box.upper[1] = box.lower[1];
  CHECK(fault_of(box).find("Box.upper") == 0);
}

}  // namespace pbf
