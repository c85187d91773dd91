#include "pbf/render/deposit.hpp"

#include "pbf/core/parallel.hpp"

#include <algorithm>

namespace pbf {
namespace {

/// Most parts that the particles are added up in, each of this many or more.
constexpr Index kMostParts = 4;
constexpr Index kLeastPart = 1 << 14;

}  // namespace

void Deposit::Part::add(const Shares& shares, Index count, std::span<const Size> grids) {
  const auto add_one = [&](Index i) {
    const Real amount = shares.amount[i];
    if (amount == 0) return;
    const auto grid = static_cast<std::size_t>(shares.grid[i]);
    const Size size = grids[grid];
    if (cells[grid] == nullptr) {
      room[grid].assign(static_cast<std::size_t>(size.width) * size.height, 0);
      cells[grid] = room[grid].data();
    }
    Real* at = cells[grid] + shares.cell[i];
    const Real upper = amount * shares.up[i], lower = amount - upper;
    const Real lower_right = lower * shares.right[i], upper_right = upper * shares.right[i];
    at[0] += lower - lower_right;
    at[1] += lower_right;
    at[size.width] += upper - upper_right;
    at[size.width + 1] += upper_right;
  };
  // Particles that follow one another often add to the same cell, and each addition would wait for
  // the last: those of four parts take turns.
  const Index quarter = count / 4;
  for (Index i = 0; i < quarter; ++i) {
    for (int part = 0; part < 4; ++part) add_one(part * quarter + i);
  }
  for (Index i = 4 * quarter; i < count; ++i) add_one(i);
}

void Deposit::add(std::span<const Size> grids,
                  Index n,
                  int threads,
                  const std::function<Find>& find) {
  const Index parts = std::clamp<Index>(n / kLeastPart, 1, kMostParts);
  const Index length = std::max<Index>((n + parts - 1) / parts, 1);
  parts_.resize(static_cast<std::size_t>(parts));
  for (Part& part : parts_) {
    part.room.resize(grids.size());
    part.cells.assign(grids.size(), nullptr);
  }
  parallel_chunks(n, threads, length, [&](Index first, Index last) {
    Part& part = parts_[static_cast<std::size_t>(first / length)];
    Shares shares;
    for (Index begin = first; begin < last; begin += Shares::kMost) {
      const Index end = std::min(begin + Shares::kMost, last);
      find(begin, end, shares);
      part.add(shares, end - begin, grids);
    }
  });
}

bool Deposit::has(std::size_t grid) const {
  return std::ranges::any_of(parts_, [&](const Part& part) { return part.cells[grid] != nullptr; });
}

void Deposit::add_to(std::span<Real> cells, std::size_t grid, int threads) const {
  parallel_chunks(std::ssize(cells), threads, Index{1} << 14, [&](Index first, Index last) {
    for (const Part& part : parts_) {
      const Real* from = part.cells[grid];
      if (from == nullptr) continue;
      for (Index k = first; k < last; ++k) cells[static_cast<std::size_t>(k)] += from[k];
    }
  });
}

}  // namespace pbf
