#include "pbf/render/full_cells.hpp"

#include "pbf/core/parallel.hpp"
#include "pbf/render/extent.hpp"

#include <algorithm>

namespace pbf {
namespace {

constexpr int kMargin = 2;         // cells on each side of the particles
constexpr double kMostCells = 32;  // to a particle
constexpr Index kBlock = 1 << 14;  // cells or particles at a time

}  // namespace

template <class Combine>
void FullCells::around(Flags& cells, int reach, int threads, Combine&& combine) {
  for (const Index stride : strides_) {
    // In the margin there need not be that many: what is found there means nothing.
    const Index margin = stride * reach;
    scratch_.resize(cells.size());
    parallel_chunks(std::ssize(cells) - 2 * margin, threads, kBlock, [&](Index first, Index last) {
      const Index count = last - first;
      std::uint8_t* to = scratch_.data() + margin + first;
      const std::uint8_t* from = cells.data() + first;
      std::copy_n(from, count, to);
      for (Index tap = 1; tap <= 2 * reach; ++tap) {
        from += stride;
        for (Index k = 0; k < count; ++k)
          to[k] = static_cast<std::uint8_t>(combine(to[k], from[k]));
      }
    });
    cells.swap(scratch_);
  }
}

void FullCells::find(const PointsView& positions, Real side, int threads) {
  const Index n = positions.cols();
  const Extent body = extent(positions, Eigen::Matrix<Real, 3, 3>::Identity(), threads);
  const double per_meter = 1 / static_cast<double>(side);
  const Eigen::Array3d first = (body.lower * per_meter).floor() - kMargin;
  const Eigen::Array3d counts = (body.upper * per_meter).floor() + kMargin + 1 - first;
  cells_.assign(static_cast<std::size_t>(n), 0);
  places_.assign(1, Place::open);
  if (n == 0 || !(counts.prod() <= std::min(kMostCells * static_cast<double>(n), 4e9))) return;
  const Eigen::Array<Index, 3, 1> sides = counts.cast<Index>();
  strides_ = {1, sides[0], sides[0] * sides[1]};
  const auto size = static_cast<std::size_t>(sides.prod());
  holds_.assign(size, 0);
  parallel_chunks(n, threads, kBlock, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i) {
      const Eigen::Array3d at = positions.col(i).cast<double>().array() * per_meter - first;
      if (!((at >= 0).all() && (at < counts).all())) continue;
      const auto cell = static_cast<std::size_t>(static_cast<Index>(at[0]) +
                                                 static_cast<Index>(at[1]) * strides_[1] +
                                                 static_cast<Index>(at[2]) * strides_[2]);
      cells_[static_cast<std::size_t>(i)] = static_cast<std::uint32_t>(cell);
      __atomic_store_n(&holds_[cell], std::uint8_t{1}, __ATOMIC_RELAXED);
    }
  });

  full_ = holds_;
  around(full_, 1, threads, [](int a, int b) { return a & b; });
  // Beyond the margin there may be a particle that flew off: all of the margin is open.
  places_.assign(size, Place::open);
  near_open_.assign(size, 1);
  const auto for_inner = [&](auto&& f) {
    parallel_chunks(sides[2] - 2 * kMargin, threads, 1, [&](Index z, Index) {
      for (Index y = kMargin; y < sides[1] - kMargin; ++y) {
        const Index row = (z + kMargin) * strides_[2] + y * strides_[1];
        for (Index x = kMargin; x < sides[0] - kMargin; ++x) f(static_cast<std::size_t>(row + x));
      }
    });
  };
  for_inner([&](std::size_t k) { near_open_[k] = holds_[k] & (full_[k] ^ 1); });
  around(near_open_, 2, threads, [](int a, int b) { return a | b; });
  for_inner([&](std::size_t k) {
    if (full_[k] != 0) places_[k] = near_open_[k] != 0 ? Place::full : Place::deep;
  });
}

}  // namespace pbf
