#include "pbf/boundary/wall_lattice.hpp"
#include "pbf/kernels/calibration.hpp"

#include <doctest/doctest.h>

#include "samples.hpp"
#include <vector>

namespace pbf {
namespace {

constexpr Real kSpacing = 0.1F;
constexpr Real kH = 0.2F;

std::vector<Vec3> sites_near(const WallLattice& lattice, const Vec3& x) {
  std::vector<Vec3> sites(lattice.most_near());
  sites.resize(static_cast<std::size_t>(lattice.collect_near(x, sites.data()) - sites.data()));
  return sites;
}

/// The lattice of a box whose sides are multiples of the spacing: one cubic lattice, less the box's
/// inside.
std::vector<Vec3> sites_by_brute_force(const Box& box, const Vec3& x) {
  std::vector<Vec3> sites;
  const Vec3 margin = Vec3::Constant(2 * kSpacing);
  const Points lattice = block(box.lower - margin, box.upper + margin, kSpacing);
  for (Index k = 0; k < lattice.cols(); ++k) {
    const Vec3 q = lattice.col(k);
    if (!box.contains(q) && (x - q).norm() < kH) sites.push_back(q);
  }
  return sites;
}

}  // namespace

TEST_CASE("wall lattice: the sites near a point are those of the whole lattice") {
  const Box box{.lower = {0, 0, 0}, .upper = {1.0F, 0.5F, 0.7F}};
  const WallLattice lattice(box, kSpacing, kH);
  const Points points = samples::jittered_block(box.lower, box.upper, kSpacing, 0.45F);
  for (Index i = 0; i < points.cols(); ++i) {
    const Vec3 x = points.col(i);
    Vec3 sum = Vec3::Zero();
    std::size_t count = 0;
    for (const Vec3& q : sites_near(lattice, x)) {
      REQUIRE_FALSE(box.contains(q));
      sum += q - x;
      ++count;
    }
    const auto expected = sites_by_brute_force(box, x);
    Vec3 expected_sum = Vec3::Zero();
    for (const Vec3& q : expected) expected_sum += q - x;
    REQUIRE(count == expected.size());
    REQUIRE((sum - expected_sum).norm() < 1e-5F);
  }
}

TEST_CASE("wall lattice: a full box is at rest density up to walls, edges and corners") {
  const Box box{.lower = {0, 0, 0}, .upper = {0.5F, 0.5F, 0.5F}};
  const WallLattice lattice(box, kSpacing, kH);
  const Points x = block(box.lower, box.upper, kSpacing);
  const double V = calibrate(KernelChoice::poly6_spiky, 3, kSpacing, kH).volume;
  const Poly6Spiky<double> kernel(kH);
  for (Index i = 0; i < x.cols(); ++i) {
    double sum = 0;
    for (Index j = 0; j < x.cols(); ++j)
      sum += kernel.W((x.col(i) - x.col(j)).cast<double>().squaredNorm());
    for (const Vec3& q : sites_near(lattice, x.col(i))) {
      sum += kernel.W((x.col(i) - q).cast<double>().squaredNorm());
    }
    CHECK(V * sum == doctest::Approx(1.0).epsilon(1e-5));
  }
}

TEST_CASE("wall lattice: a box that no whole number of particles fits is closed on all sides") {
  const Box box{.lower = {0, 0, 0}, .upper = {0.33F, 0.98F, 0.147F}};
  const WallLattice lattice(box, kSpacing, kH);
  for (int axis = 0; axis < 3; ++axis) {
    for (const Real side : {0.0F, 1.0F}) {
      CAPTURE(axis);
      CAPTURE(side);
      Vec3 x = (box.lower + box.upper) / 2;  // on the wall, in the middle of it
      x[axis] = side * box.upper[axis];
      Real reach = 0;
      int count = 0;
      for (const Vec3& q : sites_near(lattice, x)) {
        const Real outward = (side > 0 ? 1.0F : -1.0F) * (q[axis] - x[axis]);
        reach = std::max(reach, outward);
        count += static_cast<int>(outward > 0);
      }
      CHECK(reach ==
            doctest::Approx(1.5 * kSpacing));  // two layers, the second 1.5 spacings outside
      CHECK(count >= 9);
    }
  }
}

TEST_CASE("wall lattice: nothing is near in the middle of a large box") {
  const WallLattice lattice({.lower = {-50, -50, -50}, .upper = {50, 50, 50}}, kSpacing, kH);
  CHECK(sites_near(lattice, {1, 2, 3}).empty());
}

TEST_CASE("box: projection goes to the nearest point and keeps what is not a number") {
  const Box box{.lower = {0, 0, 0}, .upper = {1, 2, 3}};
  CHECK(box.project({-1, 1, 4}) == Vec3(0, 1, 3));
  CHECK(box.project({0.5F, 0.5F, 0.5F}) == Vec3(0.5F, 0.5F, 0.5F));
  CHECK(std::isnan(box.project({0.5F, std::numeric_limits<Real>::quiet_NaN(), 0.5F})[1]));
}

}  // namespace pbf
