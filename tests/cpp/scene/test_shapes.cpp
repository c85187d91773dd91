#include "pbf/core/error.hpp"
#include "pbf/scene/shapes.hpp"

#include <doctest/doctest.h>

#include <limits>

namespace pbf {

TEST_CASE("block: a side that is a multiple of the spacing holds that many layers") {
  for (const Real spacing : {0.01F, 0.02F, 0.05F, 0.1F}) {
    CAPTURE(spacing);
    const Points x = block({0, 0, 0}, {0.6F, 0.8F, 0.5F}, spacing);
    const auto layers = [&](double side) {
      return std::lround(side / static_cast<double>(spacing));
    };
    CHECK(x.cols() == layers(0.6) * layers(0.8) * layers(0.5));
    CHECK(x.minCoeff() == doctest::Approx(spacing / 2));
    CHECK(x.row(1).maxCoeff() == doctest::Approx(0.8F - spacing / 2));
  }
}

TEST_CASE("block: no particle lies outside, and a box thinner than the spacing is empty") {
  const Points x = block({0, 0, 0}, {0.55F, 0.37F, 0.21F}, 0.1F);
  CHECK(x.cols() == 5 * 3 * 2);
  CHECK(block({0, 0, 0}, {1, 0.05F, 1}, 0.1F).cols() == 0);
}

TEST_CASE("ball: holds the volume of a ball") {
  const Points x = ball({1, 2, 3}, 0.5F, 0.02F);
  CHECK((x.colwise() - Vec3(1, 2, 3)).colwise().norm().maxCoeff() <= 0.5F);
  CHECK(static_cast<double>(x.cols()) * 8e-6 == doctest::Approx(0.5236).epsilon(0.01));
}

TEST_CASE("shapes: in 2-D one layer, midway between the corners or through the center") {
  const Points x = block({0, 0, 1}, {0.6F, 0.8F, 2}, 0.1F, 2);
  CHECK(x.cols() == 6 * 8);
  CHECK((x.row(2).array() == 1.5F).all());
  const Points disk = ball({1, 2, 0.3F}, 0.5F, 0.02F, 2);
  CHECK((disk.row(2).array() == 0.3F).all());
  CHECK(static_cast<double>(disk.cols()) * 4e-4 == doctest::Approx(0.7854).epsilon(0.01));
}

TEST_CASE("shapes: what breaks a rule is refused before memory is asked for") {
  CHECK_THROWS_AS(block({0, 0, 0}, {1, 1, 1}, 0), InvalidParameter);
  CHECK_THROWS_AS(block({0, 0, 0}, {1, -1, 1}, 0.1F), InvalidParameter);
  CHECK_THROWS_AS(block({0, 0, 0}, {1e6F, 1e6F, 1e6F}, 1e-3F), InvalidParameter);
  CHECK_THROWS_AS(block({0, 0, 0}, {1, 1, 1}, 0.1F, 1), InvalidParameter);
  CHECK_THROWS_AS(ball({0, 0, 0}, std::numeric_limits<Real>::infinity(), 0.1F), InvalidParameter);
}

}  // namespace pbf
