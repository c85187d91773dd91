#include "pbf/core/error.hpp"
#include "pbf/neighbors/neighbor_list.hpp"
#include "pbf/neighbors/reorder.hpp"

#include <doctest/doctest.h>

#include "samples.hpp"

namespace pbf {
namespace {

std::set<std::pair<Index, Index>> pairs_by_grid(const Points& x, Real h, int threads = 2) {
  CellGrid grid;
  grid.build(records_of(x), h, threads);
  NeighborList list;
  list.build(grid, records_of(gathered(x, grid.order())), h, threads);
  std::set<std::pair<Index, Index>> pairs;
  for (Index k = 0; k < list.size(); ++k) {
    for (const std::uint32_t j : list[k]) {
      pairs.emplace(grid.order()[static_cast<std::size_t>(k)], grid.order()[j]);
    }
  }
  return pairs;
}

Points random_points(Index n, Real size) {
  std::mt19937 random(7);
  std::uniform_real_distribution<Real> coordinate(-size, size);
  return Points::NullaryExpr(3, n, [&] { return coordinate(random); });
}

}  // namespace

TEST_CASE("neighbor list: finds the pairs that brute force finds") {
  SUBCASE("jittered block") {
    const Points x = samples::jittered_block({0, 0, 0}, {0.2F, 0.16F, 0.18F}, 0.02F, 0.4F);
    CHECK(pairs_by_grid(x, 0.04F) == samples::pairs_by_brute_force(x, 0.04F));
  }
  SUBCASE("scattered over space, most cells empty") {
    const Points x = random_points(700, 0.5F);
    CHECK(pairs_by_grid(x, 0.1F) == samples::pairs_by_brute_force(x, 0.1F));
  }
  SUBCASE("two clouds a kilometer apart") {
    Points x = random_points(400, 0.1F);
    x.rightCols(200).colwise() += Vec3(1000, -1000, 1000);
    CHECK(pairs_by_grid(x, 0.05F) == samples::pairs_by_brute_force(x, 0.05F));
  }
  SUBCASE("all in one cell, one coincident pair") {
    Points x = random_points(50, 0.01F);
    x.col(1) = x.col(0);
    CHECK(pairs_by_grid(x, 0.05F) == samples::pairs_by_brute_force(x, 0.05F));
  }
  SUBCASE("on a lattice as wide as the support radius: none, the distance is not less") {
    CHECK(pairs_by_grid(block({0, 0, 0}, {2, 2, 2}, 0.5F), 0.5F).empty());
  }
  SUBCASE("no particle, one particle") {
    CHECK(pairs_by_grid(Points(3, 0), 0.1F).empty());
    CHECK(pairs_by_grid(Points::Zero(3, 1), 0.1F).empty());
  }
}

TEST_CASE("cell grid: the order is a permutation and does not depend on threads") {
  const Points x = random_points(50'000, 1.0F);
  CellGrid one, four;
  one.build(records_of(x), 0.1F, 1);
  four.build(records_of(x), 0.1F, 4);
  CHECK(one.order() == four.order());
  std::vector<std::uint32_t> sorted = one.order();
  std::sort(sorted.begin(), sorted.end());
  for (std::uint32_t k = 0; k < sorted.size(); ++k) REQUIRE(sorted[k] == k);
}

TEST_CASE("cell grid: positions that no grid can hold are refused") {
  Points x = Points::Zero(3, 2);
  CellGrid grid;
  x(1, 1) = std::numeric_limits<Real>::quiet_NaN();
  CHECK_THROWS_AS(grid.build(records_of(x), 0.1F, 1), SimulationFailed);
  x(1, 1) = 1e30F;
  CHECK_THROWS_AS(grid.build(records_of(x), 0.1F, 1), SimulationFailed);
}

TEST_CASE("neighbor list: a heap of particles is an error, not endless memory") {
  const Points x = Points::Zero(3, kMostNeighbors + 2);
  CHECK_THROWS_AS(pairs_by_grid(x, 0.1F), SimulationFailed);
}

}  // namespace pbf
