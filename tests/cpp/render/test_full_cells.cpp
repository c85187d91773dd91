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

TEST_CASE("full_cells: a cube is a body, and from the fourth layer on deep") {
  const Points x = cube(10, {-3, 40, 7});
  for (const int threads : {1, 3}) {
    FullCells cells;
    cells.find(x, 0.5F, threads);
    for (Index i = 0; i < x.cols(); ++i) {
      const Index at[] = {i % 10, i / 10 % 10, i / 100};
      Index layer = 9;
      for (const Index k : at) layer = std::min({layer, k, 9 - k});
      CHECK(cells[i] == (layer < 3 ? Place::body : Place::deep));
    }
  }
}

TEST_CASE("full_cells: 27 cells are the least body, and a hole must leave as many") {
  Points x = cube(3, Vec3::Zero());
  FullCells cells;
  cells.find(x, 0.5F, 0);
  for (Index i = 0; i < x.cols(); ++i) CHECK(cells[i] == Place::body);
  x.col(26) = x.col(0);
  cells.find(x, 0.5F, 0);
  for (Index i = 0; i < x.cols(); ++i) CHECK(cells[i] == Place::loose);
}

TEST_CASE("full_cells: who is beside a loose one") {
  // A rod of single cells stands out of a cube of 9, from the middle of its face x = 4.5.
  Points x = cube(9, Vec3::Zero());
  const Index body = x.cols();
  x.conservativeResize(3, body + 6);
  for (Index k = 0; k < 6; ++k)
    x.col(body + k) << 4.75F + 0.5F * static_cast<Real>(k), 2.25F, 2.25F;
  FullCells cells;
  cells.find(x, 0.5F, 0);
  for (Index i = 0; i < body; ++i) {
    const Index a = i % 9, b = i / 9 % 9, c = i / 81;
    const bool beside = a > 6 && std::abs(b - 4) <= 2 && std::abs(c - 4) <= 2;
    CHECK((cells[i] == Place::beside) == beside);
    CHECK(cells[i] != Place::loose);
  }
  for (Index k = 0; k < 6; ++k) CHECK(cells[body + k] == Place::loose);
}

TEST_CASE("full_cells: nobody is deep near a hole") {
  Points x = cube(11, Vec3::Zero());
  x.col(5 * 121 + 5 * 11 + 5) = x.col(0);  // the middle is empty
  FullCells cells;
  cells.find(x, 0.5F, 0);
  for (Index i = 0; i < x.cols(); ++i) CHECK(cells[i] == Place::body);
}

TEST_CASE("full_cells: all are loose alone, scattered widely, and far off") {
  FullCells cells;
  cells.find(Points(Vec3(1, 2, 3)), 0.5F, 0);
  CHECK(cells[0] == Place::loose);
  Points x = 1e6F * cube(5, Vec3::Zero());
  cells.find(x, 0.5F, 0);
  for (Index i = 0; i < x.cols(); ++i) CHECK(cells[i] == Place::loose);
  x = cube(10, Vec3::Zero());
  x.col(0) << 1e20F, -1e20F, 0;
  cells.find(x, 0.5F, 0);
  CHECK(cells[0] == Place::loose);
  CHECK(cells[5 * 111] == Place::deep);
  CHECK(cells[999] == Place::beside);  // it could be just outside of the block
}
