#include "pbf/render/full_cells.hpp"

#include <doctest/doctest.h>

#include <random>

using namespace pbf;
using Place = FullCells::Place;

namespace {

/// One position in each cell of a cube, cells of side 0.5, at random within the cell.
Points cube(Index side, const Vec3& corner) {
  std::mt19937 random(2);
  std::uniform_real_distribution<Real> within(0.01F, 0.99F);
  Points x(3, side * side * side);
  for (Index i = 0; i < x.cols(); ++i) {
    const Eigen::Vector3<Index> cell(i % side, i / side % side, i / (side * side));
    const Vec3 at(within(random), within(random), within(random));
    x.col(i) = corner + 0.5F * (cell.cast<Real>() + at);
  }
  return x;
}

}  // namespace

TEST_CASE(
    "full_cells: of a cube all but the outermost layer is full, and from the fourth on deep") {
  const Points x = cube(10, {-3, 40, 7});
  for (const int threads : {1, 3}) {
    FullCells cells;
    cells.find(x, 0.5F, threads);
    for (Index i = 0; i < x.cols(); ++i) {
      const Index at[] = {i % 10, i / 10 % 10, i / 100};
      Index layer = 9;
      for (const Index k : at) layer = std::min({layer, k, 9 - k});
      const Place expected = layer == 0 ? Place::open : layer < 3 ? Place::full : Place::deep;
      CHECK(cells[i] == expected);
    }
  }
}

TEST_CASE("full_cells: a hole opens the cells around it") {
  Points x = cube(11, Vec3::Zero());
  x.col(5 * 121 + 5 * 11 + 5) = x.col(0);  // the middle is empty
  FullCells cells;
  cells.find(x, 0.5F, 0);
  for (Index i = 0; i < x.cols(); ++i) {
    const Index x_i = i % 11, y = i / 11 % 11, z = i / 121;
    const Index away = std::max({std::abs(x_i - 5), std::abs(y - 5), std::abs(z - 5)});
    if (away == 1) CHECK(cells[i] == Place::open);
    if (away == 2 || away == 3) CHECK(cells[i] == Place::full);
  }
}

TEST_CASE("full_cells: all are open alone, scattered widely, and far off") {
  FullCells cells;
  cells.find(Points(Vec3(1, 2, 3)), 0.5F, 0);
  CHECK(cells[0] == Place::open);
  Points x = 1e6F * cube(5, Vec3::Zero());
  cells.find(x, 0.5F, 0);
  for (Index i = 0; i < x.cols(); ++i) CHECK(cells[i] == Place::open);
  x = cube(10, Vec3::Zero());
  x.col(0) << 1e20F, -1e20F, 0;
  cells.find(x, 0.5F, 0);
  CHECK(cells[0] == Place::open);
  CHECK(cells[5 * 111] == Place::deep);
}
