#include "pbf/core/error.hpp"
#include "pbf/fluid/particle_fields.hpp"

#include <Eigen/Geometry>
#include <doctest/doctest.h>

#include "samples.hpp"

namespace pbf {
namespace {

constexpr Real kSpacing = 0.05F;
constexpr Real kH = 2 * kSpacing;

Points sample() {
  return samples::jittered_block(Vec3::Zero(), Vec3::Constant(0.5F), kSpacing, 0.2F);
}

}  // namespace

TEST_CASE(
    "particle fields: corrected derivatives of linear fields are exact, at the free surface too") {
  const Points x = sample();
  const ParticleFields fields(x, kH, {.corrected = true});
  const Vec3 slope{1, -2, 3};
  const Scalars A = (slope.transpose() * x).transpose().array() + 7;
  CHECK((fields.gradient(A).colwise() - slope).cwiseAbs().maxCoeff() < 1e-3F);

  const Vec3 spin{0.3F, -0.4F, 0.5F};
  Points rotation(3, x.cols());
  for (Index i = 0; i < x.cols(); ++i) rotation.col(i) = spin.cross(Vec3(x.col(i)));
  CHECK((fields.curl(rotation).colwise() - 2 * spin).cwiseAbs().maxCoeff() < 1e-3F);
  CHECK(fields.divergence(rotation).abs().maxCoeff() < 1e-3F);
  CHECK((fields.divergence(x) - 3).abs().maxCoeff() < 1e-3F);
}

TEST_CASE("particle fields: a constant has no derivative") {
  const Points x = sample();
  const ParticleFields fields(x, kH, {});
  CHECK(fields.gradient(Scalars::Constant(x.cols(), 5)).cwiseAbs().maxCoeff() == 0);
  CHECK(fields.laplacian(Scalars::Constant(x.cols(), 5)).abs().maxCoeff() == 0);
}

TEST_CASE("particle fields: the Laplacian of |x|² is six inside a lattice") {
  const Points x = block(Vec3::Zero(), Vec3::Constant(0.6F), kSpacing);
  const ParticleFields fields(x, kH, {.kernel = KernelChoice::cubic_spline});
  const Scalars values = x.colwise().squaredNorm().transpose().array();
  const Scalars laplacian = fields.laplacian(values);
  Index inner = 0;
  for (Index i = 0; i < x.cols(); ++i) {
    if ((x.col(i).array() > kH && x.col(i).array() < 0.6F - kH).all()) {
      REQUIRE(laplacian[i] == doctest::Approx(6.0).epsilon(0.05));
      ++inner;
    }
  }
  CHECK(inner > 0);
}

TEST_CASE("particle fields: the same bits for any number of threads") {
  const Points x = sample();
  const Scalars A = x.row(0).transpose().array().sin();
  const Points one = ParticleFields(x, kH, {.num_threads = 1}).gradient(A);
  for (const int threads : {2, 3, 7}) {
    CHECK(ParticleFields(x, kH, {.num_threads = threads}).gradient(A) == one);
  }
}

TEST_CASE("particle fields: what breaks a rule is refused") {
  const Points x = sample();
  CHECK_THROWS_AS(ParticleFields(x, 0, {}), InvalidParameter);
  CHECK_THROWS_AS(ParticleFields(x, kH, {.volume = -1}), InvalidParameter);
  CHECK_THROWS_AS(ParticleFields(x, kH, {}).gradient(Scalars::Zero(3)), InvalidParameter);
}

}  // namespace pbf
