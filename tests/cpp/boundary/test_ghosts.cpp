#include "pbf/fluid/discretization.hpp"
#include "pbf/neighbors/reorder.hpp"

#include <doctest/doctest.h>

#include "samples.hpp"

namespace pbf {
namespace {

constexpr Real kSpacing = 0.05F;
using Pairs = std::multiset<std::pair<Index, Index>>;

/// The pairs that a neighborhood lists, a ghost being its particle.
Pairs pairs_listed(const Points& positions, const Box& box, int threads = 2) {
  const Discretization disc({.spacing = kSpacing}, box);
  CellGrid grid;
  Neighborhood near;
  Records unsorted = records_of(positions);
  near.sort(unsorted, disc, threads, grid);
  const auto outside = [&](Index place) { return grid.order()[static_cast<std::size_t>(place)]; };
  Records x(positions.cols());
  for (Index k = 0; k < x.size(); ++k) x[k] = unsorted[outside(k)];
  near.build(grid, disc, threads, x);
  Pairs pairs;
  for (Index k = 0; k < positions.cols(); ++k) {
    for (const Index j : near.fluid[k]) {
      pairs.emplace(outside(k),
                    outside(j < grid.particles() ? j : near.ghosts.source(j - grid.particles())));
    }
  }
  return pairs;
}

/// All pairs whose nearest images are closer than h, by looking at every pair.
Pairs pairs_by_brute_force(const Points& x, const Box& box) {
  Pairs pairs;
  const double h = static_cast<double>(2 * kSpacing);
  const Eigen::Array3d period = (box.upper - box.lower).cast<double>();
  for (Index i = 0; i < x.cols(); ++i) {
    for (Index j = 0; j < x.cols(); ++j) {
      Eigen::Array3d r = (x.col(i).cast<double>() - x.col(j).cast<double>()).array();
      for (int axis = 0; axis < 3; ++axis) {
        if (box.periodic[static_cast<std::size_t>(axis)])
          r[axis] -= period[axis] * std::round(r[axis] / period[axis]);
      }
      if (i != j && r.matrix().norm() < h) pairs.emplace(i, j);
    }
  }
  return pairs;
}

}  // namespace

TEST_CASE("ghosts: lists name every neighbor once, across faces, edges and corners") {
  // As short as a period may be along y.
  const Vec3 lower{-0.3F, 0.1F, 0.2F}, upper{0.1F, 0.3F, 0.55F};
  Points x = samples::jittered_block(lower, upper, kSpacing, 0.45F);
  x.col(0) = lower;  // in a corner itself
  for (int axes = 0; axes < 8; ++axes) {
    CAPTURE(axes);
    const Box box{
        .lower = lower, .upper = upper, .periodic = {axes % 2 > 0, axes / 2 % 2 > 0, axes / 4 > 0}};
    const Pairs pairs = pairs_listed(x, box);
    CHECK(pairs == pairs_by_brute_force(x, box));
    CHECK(pairs == pairs_listed(x, box, 7));
  }
}

TEST_CASE("ghosts: there are none without periodic axes, nor away from the faces") {
  Records x = records_of(block({0, 0, 0}, {1, 1, 1}, 0.1F));
  Ghosts ghosts;
  ghosts.append(Box{}, 0.2F, x, 2);
  CHECK(ghosts.size() == 0);
  CHECK(x.size() == 1000);
  Records middle = records_of(Points::Constant(3, 1, 0.5F));
  ghosts.append(Box{.periodic = {true, true, true}}, 0.2F, middle, 2);
  CHECK(ghosts.size() == 0);
}

TEST_CASE("ghosts: a particle in a corner has seven, each a period away") {
  const Box box{.upper = {1, 2, 4}, .periodic = {true, true, true}};
  Records x = records_of(Points::Constant(3, 1, 0.125F));
  Ghosts ghosts;
  ghosts.append(box, 0.25F, x, 1);
  REQUIRE(ghosts.size() == 7);
  std::set<std::array<Real, 3>> places;
  for (Index k = 1; k < x.size(); ++k) places.insert({x[k].x, x[k].y, x[k].z});
  CHECK(places.size() == 7);
  CHECK(places.contains({1.125F, 0.125F, 0.125F}));
  CHECK(places.contains({1.125F, 2.125F, 4.125F}));

  Records v(1);
  v[0] = {1, 2, 3, 4};
  ghosts.refresh(v, 1);
  REQUIRE(v.size() == 8);
  CHECK(vec3(v[7]) == Vec3(1, 2, 3));
  CHECK(v[7].w == 4);
}

TEST_CASE("box: wrapping gives the image between lower, which counts, and upper") {
  const Box box{.lower = {-1, 0, 0}, .upper = {2, 1, 1}, .periodic = {true, true, false}};
  CHECK(box.wrap(0, 1.5F) == 1.5F);
  CHECK(box.wrap(0, 2) == -1);
  CHECK(box.wrap(0, -1.5F) == 1.5F);
  CHECK(box.wrap(0, 300.5F) == 0.5F);
  CHECK(box.wrap(1, -1e-9F) == 0);  // 1 − 1e-9 would round to the upper face
  CHECK(box.wrap(2, 7) == 7);       // not periodic
  const Real infinity = std::numeric_limits<Real>::infinity();
  CHECK(box.wrap(0, infinity) == infinity);
  CHECK(box.wrap(0, 1e30F) == 1e30F);  // any image of it would be a guess
  CHECK(std::isnan(box.wrap(0, std::numeric_limits<Real>::quiet_NaN())));
}

TEST_CASE("discretization: a period that is too short or too long is refused, as is z in 2-D") {
  const FluidParams fluid{.spacing = kSpacing};
  const auto make = [&](const FluidParams& params, const Vec3& upper, const Axes& periodic) {
    return Discretization(params, Box{.upper = upper, .periodic = periodic});
  };
  CHECK_NOTHROW(make(fluid, {0.2F, 1, 1}, {true, false, false}));
  CHECK_THROWS_AS(make(fluid, {0.19F, 1, 1}, {true, false, false}), InvalidParameter);
  CHECK_NOTHROW(make(fluid, {0.19F, 1, 1}, {false, true, false}));
  CHECK_THROWS_AS(make(fluid, {1, 1, 2e5F}, {false, false, true}), InvalidParameter);
  const FluidParams flat{.spacing = kSpacing, .dimensions = 2};
  CHECK_NOTHROW(make(flat, {1, 1, 0.01F}, {true, true, false}));
  CHECK_THROWS_AS(make(flat, {1, 1, 1}, {true, true, true}), InvalidParameter);
}

}  // namespace pbf
