#include "pbf/fluid/coarse_system.hpp"

#include "pbf/core/parallel.hpp"

#include <algorithm>
#include <cmath>

namespace pbf {
namespace {

constexpr double kEnough = 0.1;
constexpr int kMostSteps = 200;

template <class T>
std::size_t bytes_of(const std::vector<T>& values) {
  return values.capacity() * sizeof(T);
}

void sort_unique(std::vector<CellKey>& keys) {
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
}

std::uint32_t place_in(const std::vector<CellKey>& keys, CellKey key) {
  return static_cast<std::uint32_t>(std::lower_bound(keys.begin(), keys.end(), key) - keys.begin());
}

}  // namespace

CoarseCell& CoarseCell::operator+=(const CoarseCell& other) {
  for (std::size_t c = 0; c < kCorners; ++c) {
    for (std::size_t e = 0; e < kCorners; ++e) matrix[c][e] += other.matrix[c][e];
    right[c] += other.right[c];
  }
  return *this;
}

void CoarseSystem::reset(const CoarseGrid& grid, std::vector<CellKey>& cells, int threads) {
  sort_unique(cells);
  keys_ = cells;
  cells_.assign(keys_.size(), {});
  corners_.resize(keys_.size());
  parts_.resize(keys_.size());
  std::vector<CellKey> corners;
  corners.reserve(kCorners * keys_.size());
  for (const CellKey cell : keys_)
    for (int c = 0; c < kCorners; ++c) corners.push_back(grid.corner(cell, c));
  sort_unique(corners);
  around_.resize(corners.size());
  for (auto& around : around_) around.fill(-1);
  // A corner is a cell's corner number c at most once, so that no two threads write one number.
  parallel_for(static_cast<Index>(keys_.size()), threads, [&](Index cell) {
    for (int c = 0; c < kCorners; ++c) {
      const auto i = static_cast<std::size_t>(cell), q = static_cast<std::size_t>(c);
      corners_[i][q] = place_in(corners, grid.corner(keys_[i], c));
      around_[corners_[i][q]][q] = kCorners * cell + c;
    }
  });
}

std::uint32_t CoarseSystem::place(CellKey cell) const { return place_in(keys_, cell); }

/// The sum of part(cell, corner of it) over the cells around.
template <class F>
double CoarseSystem::at_corner(std::size_t corner, F&& part) const {
  double sum = 0;
  for (const std::int64_t at : around_[corner]) {
    if (at < 0) continue;
    const auto k = static_cast<std::size_t>(at);
    sum += static_cast<double>(part(k / kCorners, k % kCorners));
  }
  return sum;
}

void CoarseSystem::multiply(const std::vector<double>& p, int threads, std::vector<double>& Ap) {
  parallel_for(static_cast<Index>(cells_.size()), threads, [&](Index cell) {
    const auto i = static_cast<std::size_t>(cell);
    PerCorner<double> in, out{};
    for (std::size_t c = 0; c < kCorners; ++c) in[c] = p[corners_[i][c]];
    for (std::size_t e = 0; e < kCorners; ++e)
      for (std::size_t c = 0; c < kCorners; ++c)
        out[c] += static_cast<double>(cells_[i].matrix[e][c]) * in[e];
    parts_[i] = out;
  });
  parallel_for(static_cast<Index>(Ap.size()), threads, [&](Index corner) {
    const auto k = static_cast<std::size_t>(corner);
    Ap[k] = at_corner(k, [&](std::size_t cell, std::size_t c) { return parts_[cell][c]; });
  });
}

void CoarseSystem::solve(int threads) {
  const std::size_t n = around_.size();
  for (auto* v : {&mu_, &r_, &z_, &p_, &Ap_, &inverse_diagonal_}) v->resize(n);
  const auto each = [&](auto&& f) {
    parallel_for(static_cast<Index>(n), threads, [&](Index k) { f(static_cast<std::size_t>(k)); });
  };
  const auto dot = [&](const std::vector<double>& a, const std::vector<double>& b) {
    return parallel_sum(static_cast<Index>(n), threads, [&](Index k) {
      return a[static_cast<std::size_t>(k)] * b[static_cast<std::size_t>(k)];
    });
  };
  each([&](std::size_t k) {
    const double d = at_corner(k, [&](std::size_t cell, std::size_t c) {
      Real sum = 0;  // over a single cell to a period, two corners are one
      for (std::size_t e = 0; e < kCorners; ++e)
        if (corners_[cell][e] == k) sum += cells_[cell].matrix[c][e];
      return sum;
    });
    // A corner that moves nothing has no equation.
    inverse_diagonal_[k] = d > 0 ? 1 / d : 0;
    mu_[k] = 0;
    r_[k] = at_corner(k, [&](std::size_t cell, std::size_t c) { return cells_[cell].right[c]; });
    p_[k] = z_[k] = inverse_diagonal_[k] * r_[k];
  });
  double rz = dot(r_, z_);
  const double enough = kEnough * kEnough * rz;
  for (int step = 0; step < kMostSteps && rz > enough; ++step) {
    multiply(p_, threads, Ap_);
    const double curvature = dot(p_, Ap_);
    if (!(curvature > 0)) return;
    const double way = rz / curvature;
    each([&](std::size_t k) {
      mu_[k] += way * p_[k];
      r_[k] -= way * Ap_[k];
      z_[k] = inverse_diagonal_[k] * r_[k];
    });
    const double next = dot(r_, z_), share = next / rz;
    each([&](std::size_t k) { p_[k] = z_[k] + share * p_[k]; });
    rz = next;
  }
}

PerCorner<Real> CoarseSystem::solution(std::uint32_t place) const {
  PerCorner<Real> values;
  for (std::size_t c = 0; c < kCorners; ++c) values[c] = static_cast<Real>(mu_[corners_[place][c]]);
  return values;
}

std::size_t CoarseSystem::bytes() const {
  return bytes_of(keys_) + bytes_of(cells_) + bytes_of(corners_) + bytes_of(around_) +
         bytes_of(parts_) + 6 * bytes_of(mu_);
}

}  // namespace pbf
