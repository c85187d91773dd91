#include "pbf/fluid/coarse_level.hpp"

#include "pbf/fluid/sweep.hpp"

#include <algorithm>
#include <cmath>

namespace pbf {
namespace {

/// What corner multipliers do to a particle: G_ic of all corners, by axis.
using Motions = std::array<PerCorner<Real>, 3>;

/// @param rows  (B_i, g_i) by axis
Motions motions_of(const std::array<Record, 3>& rows,
                   const CoarseGrid::Hats& hats,
                   const Record& x,
                   const std::optional<Box>& centers) {
  const Real place[] = {x.x, x.y, x.z};
  Motions G{};
  for (int k = 0; k < 3; ++k) {
    const auto axis = static_cast<std::size_t>(k);
    if (centers && (place[k] <= centers->lower[k] || place[k] >= centers->upper[k])) continue;
    const Record& B = rows[axis];
    for (std::size_t c = 0; c < kCorners; ++c) {
      G[axis][c] =
          hats.w[c] * B.w + B.x * hats.dw[0][c] + B.y * hats.dw[1][c] + B.z * hats.dw[2][c];
    }
  }
  return G;
}

void add_products(const PerCorner<Real>& a, const PerCorner<Real>& b, CoarseCell& cell) {
  for (std::size_t c = 0; c < kCorners; ++c)
    for (std::size_t e = 0; e < kCorners; ++e) cell.matrix[c][e] += a[c] * b[e];
}

PerCorner<Real> times(Real factor, PerCorner<Real> values) {
  for (Real& value : values) value *= factor;
  return values;
}

}  // namespace

/// Most particles are in the cell of the one before.
std::size_t CoarseLevel::Chunk::find(CellKey key, std::size_t guess) const {
  if (guess < keys.size() && keys[guess] == key) return guess;
  return static_cast<std::size_t>(std::find(keys.begin(), keys.end(), key) - keys.begin());
}

void CoarseLevel::correct(const Neighborhood& near,
                          const Discretization& disc,
                          Real compliance,
                          int threads,
                          const Records& x_star,
                          Records& states,
                          Records& x_delta) {
  x_pressed_.resize(x_star.size());
  parallel_for(states.size(), threads, [&](Index i) {
    const Record& x = x_star[i];
    x_pressed_[i] = {x.x, x.y, x.z, states[i].x < 0 ? Real(1) : Real(0)};
  });
  near.ghosts.refresh_positions(x_pressed_, threads);

  const CoarseGrid grid(disc);
  gather(near, disc, grid, compliance, threads, states);
  std::vector<CellKey> keys;
  for (const Chunk& chunk : chunks_) keys.insert(keys.end(), chunk.keys.begin(), chunk.keys.end());
  system_.reset(grid, keys, threads);
  for (Chunk& chunk : chunks_) {  // in this order whatever the threads
    chunk.places.clear();
    for (std::size_t k = 0; k < chunk.keys.size(); ++k) {
      chunk.places.push_back(system_.place(chunk.keys[k]));
      system_[chunk.places[k]] += chunk.cells[k];
    }
  }
  system_.solve(threads);

  Records& x_mu = x_pressed_;  // (x*, a Σ w μ)
  parallel_chunks(states.size(), threads, kChunk, [&](Index first, Index last) {
    const Chunk& chunk = chunks_[static_cast<std::size_t>(first / kChunk)];
    std::size_t cell = 0;
    for (Index i = first; i < last; ++i) {
      if (!(x_mu[i].w > 0)) continue;
      const CoarseGrid::Hats hats = grid.at(x_star[i]);
      cell = chunk.find(hats.cell, cell);
      const PerCorner<Real> mu = system_.solution(chunk.places[cell]);
      x_mu[i].w = 0;
      for (std::size_t c = 0; c < kCorners; ++c) x_mu[i].w += hats.w[c] * mu[c];
    }
  });
  const Real before = parallel_max(states.size(), threads, [&](Index i) { return -states[i].x; });
  const Real added =
      parallel_max(states.size(), threads, [&](Index i) { return std::abs(x_mu[i].w); });
  const Real most = std::max(square(disc.fluid.spacing) - before, Real(0));
  const Real share = added > most ? most / added : 1;
  parallel_for(states.size(), threads, [&](Index i) {
    const Real total = std::min(states[i].x + share * x_mu[i].w, Real(0));
    x_delta[i].w += total - states[i].x;
    states[i].x = states[i].y = total;
  });
  near.ghosts.refresh_positions(x_delta, threads);
}

/// The cells of each chunk, from its particles.
void CoarseLevel::gather(const Neighborhood& near,
                         const Discretization& disc,
                         const CoarseGrid& grid,
                         Real compliance,
                         int threads,
                         const Records& states) {
  chunks_.resize(static_cast<std::size_t>((states.size() + kChunk - 1) / kChunk));
  sweep(near, disc, threads, [&](const auto& loops, const auto& VW, const Stretch& at) {
    CoarseMotions rows;
    loops.coarse_motions(VW, at, x_pressed_.data(), rows);
    Chunk& chunk = chunks_[static_cast<std::size_t>(at.first / kChunk)];
    chunk.keys.clear();
    chunk.cells.clear();
    std::size_t guess = 0;
    for (Index i = at.first; i < at.last; ++i) {
      const Record& x = x_pressed_[i];
      const auto k = static_cast<std::size_t>(i - at.first);
      const CoarseGrid::Hats hats = grid.at(x);
      guess = chunk.find(hats.cell, guess);
      if (guess == chunk.keys.size()) {
        chunk.keys.push_back(hats.cell);
        chunk.cells.emplace_back();
      }
      CoarseCell& cell = chunk.cells[guess];
      const Motions G = motions_of({rows.x[k], rows.y[k], rows.z[k]}, hats, x, disc.centers);
      for (const PerCorner<Real>& along : G) add_products(along, along, cell);
      if (!(x.w > 0)) continue;
      if (compliance > 0) add_products(times(compliance, hats.w), hats.w, cell);
      for (std::size_t c = 0; c < kCorners; ++c) cell.right[c] -= hats.w[c] * states[i].z;
    }
  });
}

std::size_t CoarseLevel::bytes() const {
  std::size_t sum = static_cast<std::size_t>(x_pressed_.size()) * sizeof(Record) + system_.bytes();
  for (const Chunk& chunk : chunks_) {
    sum += chunk.keys.capacity() * sizeof(CellKey) + chunk.cells.capacity() * sizeof(CoarseCell) +
           chunk.places.capacity() * sizeof(std::uint32_t);
  }
  return sum;
}

}  // namespace pbf
