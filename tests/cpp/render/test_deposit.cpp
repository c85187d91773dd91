#include "pbf/render/deposit.hpp"

#include <doctest/doctest.h>

#include <random>

using namespace pbf;

namespace {

constexpr std::array<Deposit::Size, 2> kGrids{{{7, 5}, {40, 30}}};

struct Point {
  float x, y, amount;
  int grid;
};

std::vector<Point> points(Index n) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> anywhere(0, 1);
  std::vector<Point> result;
  for (Index i = 0; i < n; ++i) {
    const int grid = i % 3 == 0 ? 1 : 0;
    const auto last_column = static_cast<float>(kGrids[grid].width) - 1.01F;
    const auto last_row = static_cast<float>(kGrids[grid].height) - 1.01F;
    result.push_back({anywhere(random) * last_column, anywhere(random) * last_row,
                      i % 5 == 0 ? 0 : anywhere(random), grid});
  }
  return result;
}

std::vector<Real> deposited(const std::vector<Point>& points, std::size_t grid, int threads) {
  Deposit deposit;
  const auto find = [&](Index first, Index last, Shares& shares) {
    for (Index i = first; i < last; ++i) {
      const Point& p = points[i];
      const Index k = i - first;
      const int column = static_cast<int>(p.x), row = static_cast<int>(p.y);
      shares.grid[k] = p.grid;
      shares.cell[k] = row * kGrids[p.grid].width + column;
      shares.right[k] = p.x - static_cast<float>(column);
      shares.up[k] = p.y - static_cast<float>(row);
      shares.amount[k] = p.amount;
    }
  };
  deposit.add(kGrids, static_cast<Index>(points.size()), threads, find);
  std::vector<Real> cells(static_cast<std::size_t>(kGrids[grid].width) * kGrids[grid].height);
  deposit.add_to(cells, grid, threads);
  return cells;
}

}  // namespace

TEST_CASE("deposit: sums of amounts, with their centers where they are, for any threads") {
  const std::vector<Point> all = points(100'000);
  for (std::size_t grid = 0; grid < kGrids.size(); ++grid) {
    const std::vector<Real> cells = deposited(all, grid, 1);
    double amount = 0, x = 0, y = 0, found = 0, found_x = 0, found_y = 0;
    for (const Point& p : all) {
      if (static_cast<std::size_t>(p.grid) != grid) continue;
      amount += static_cast<double>(p.amount);
      x += static_cast<double>(p.amount * p.x);
      y += static_cast<double>(p.amount * p.y);
    }
    for (std::size_t k = 0; k < cells.size(); ++k) {
      const auto cell = static_cast<double>(cells[k]);
      found += cell;
      found_x += cell * static_cast<double>(k % kGrids[grid].width);
      found_y += cell * static_cast<double>(k / kGrids[grid].width);
    }
    CHECK(found == doctest::Approx(amount).epsilon(1e-5));
    CHECK(found_x == doctest::Approx(x).epsilon(1e-5));
    CHECK(found_y == doctest::Approx(y).epsilon(1e-5));
    for (const int threads : {2, 3, 7}) CHECK(deposited(all, grid, threads) == cells);
  }
}

TEST_CASE("deposit: a grid is empty until something is added to it, and empty again") {
  Deposit deposit;
  const auto one = [](Index first, Index last, Shares& shares) {
    for (Index i = first; i < last; ++i) {
      shares.grid[i - first] = 1;
      shares.cell[i - first] = 3;
      shares.right[i - first] = shares.up[i - first] = 0;
      shares.amount[i - first] = 2;
    }
  };
  for (int again = 0; again < 2; ++again) {
    deposit.add(kGrids, 10, 1, one);
    CHECK(!deposit.has(0));
    CHECK(deposit.has(1));
    std::vector<Real> cells(1200);
    deposit.add_to(cells, 1, 1);
    CHECK(cells[3] == 20);
  }
  deposit.add(kGrids, 0, 1, one);
  CHECK(!deposit.has(1));
}
