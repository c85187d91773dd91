#include "pbf/render/extent.hpp"

#include <Eigen/Geometry>
#include <doctest/doctest.h>

#include "instruction_sets.hpp"
#include <random>

using namespace pbf;
using test::for_each_isa;

namespace {

using Axes = Eigen::Matrix<Real, 3, 3>;

Points box(Index n, const Vec3& lower, const Vec3& upper) {
  std::mt19937 random(1);
  std::uniform_real_distribution<Real> anywhere(0, 1);
  Points x(3, n);
  for (Index i = 0; i < n; ++i) {
    const Vec3 share(anywhere(random), anywhere(random), anywhere(random));
    x.col(i) = lower + share.cwiseProduct(upper - lower);
  }
  return x;
}

}  // namespace

TEST_CASE("extent: that of the coordinates along the axes, for any number of threads") {
  const Points x = box(20'000, {-1, 2, 5}, {3, 4, 5.5F});
  const Axes axes(Eigen::AngleAxisf(0.7F, Vec3(1, 2, 3).normalized()));
  const Points along = axes * x;
  for (const int threads : {1, 2, 7}) {
    const Extent found = extent(x, axes, threads);
    CHECK((found.lower.cast<Real>() - along.rowwise().minCoeff().array()).abs().maxCoeff() < 2e-6F);
    CHECK((found.upper.cast<Real>() - along.rowwise().maxCoeff().array()).abs().maxCoeff() < 2e-6F);
    CHECK((found.mean.cast<Real>() - along.rowwise().mean().array()).abs().maxCoeff() < 1e-3F);
  }
}

TEST_CASE("extent: the same bits for any number of threads and every instruction set") {
  Points x = box(20'011, {-1, 2, 5}, {3, 4, 5.5F});
  x.col(3) << 1e4F, 3, 5;  // what is left out hangs on mean and root mean square
  const Axes axes(Eigen::AngleAxisf(0.7F, Vec3(1, 2, 3).normalized()));
  const Extent expected = extent(x, axes, 1);
  const auto check = [&](int threads) {
    const Extent found = extent(x, axes, threads);
    CHECK((found.lower == expected.lower).all());
    CHECK((found.upper == expected.upper).all());
    CHECK((found.mean == expected.mean).all());
    CHECK((found.limit == expected.limit).all());
  };
  for (const int threads : {2, 3, 7}) check(threads);
  for_each_isa([&] { check(2); });
}

TEST_CASE("extent: who flew off along an axis does not count there") {
  Points x = box(5'000, {-1, -1, -1}, {1, 1, 1});
  for (const Real far : {1e3F, 1e30F, 3e38F}) {
    x.col(17) << 0, far, -0.5F;
    const Extent found = extent(x, Axes::Identity(), 0);
    CHECK((found.lower >= -1).all());
    CHECK((found.upper <= 1).all());
    CHECK((found.upper - found.lower > 1.99).all());
  }
}

TEST_CASE("extent: along slanted axes a coordinate may be more than a float holds") {
  Points x = box(5'000, {-1, -1, -1}, {1, 1, 1});
  x.col(17) = Vec3::Constant(3e38F);
  x.col(18) = Vec3(-3e38F, -3e38F, 3e38F);
  const Axes axes(Eigen::AngleAxisf(0.7F, Vec3(1, 2, 3).normalized()));
  const Extent found = extent(x, axes, 0);
  CHECK((found.lower >= -std::sqrt(3.0)).all());
  CHECK((found.upper <= std::sqrt(3.0)).all());
  CHECK((found.upper - found.lower > 1.99).all());
  CHECK(extent(x.middleCols(17, 2), axes, 0).upper.isFinite().all());
}

TEST_CASE("extent: of one position, of many alike, and of none") {
  const Points one(Vec3(0.1F, 2e5F, -3));
  for (const Points& x : {one, Points(one.replicate(1, 9999))}) {
    const Extent found = extent(x, Axes::Identity(), 0);
    CHECK(found.lower.cast<Real>().matrix() == one);
    CHECK(found.upper.cast<Real>().matrix() == one);
  }
  CHECK((extent(Points(3, 0), Axes::Identity(), 0).lower > 0).all());
}
