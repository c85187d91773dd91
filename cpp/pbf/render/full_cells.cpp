#include "pbf/render/full_cells.hpp"

#include "pbf/core/parallel.hpp"
#include "pbf/render/extent.hpp"
#include "pbf/render/full_cells_kernels.hpp"
#include "pbf/render/point_block.hpp"

#include <algorithm>
#include <utility>

namespace pbf {
PBF_TABLE_BY_ISA(FullCellsKernels, full_cells_kernels, full_cells_kernels)
namespace {

constexpr int kMargin = 2;         // cells on each side of the particles
constexpr double kMostCells = 32;  // to a particle
constexpr Index kBlock = 1 << 12;  // cells or particles at a time

}  // namespace

template <class Combine>
void FullCells::around(Flags& cells, int reach, int threads, Combine&& combine) {
  scratch_.resize(cells.size());
  for (const Index stride : strides_) {
    const Index margin = stride * reach;  // nobody's neighbors are looked for there
    std::copy_n(cells.begin(), margin, scratch_.begin());
    std::copy_n(cells.end() - margin, margin, scratch_.end() - margin);
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

template <class F>
void FullCells::for_cells(int threads, F&& f) const {
  parallel_chunks(sides_[2], threads, 1, [&](Index z, Index) {
    for (Index y = 0; y < sides_[1]; ++y) {
      const Index row = z * strides_[2] + y * strides_[1];
      for (Index x = 0; x < sides_[0]; ++x)
        f(static_cast<std::size_t>(row + x), CellNumber(x, y, z));
    }
  });
}

void FullCells::expose(const Vec3& direction, Real from, int threads) {
  const auto middle = [&](const Vec3& cell) -> Vec3 {
    return side_ * (first_ + cell + Vec3::Constant(0.5F));
  };
  const Vec3 nearest = (direction.array() > 0).select(Vec3::Zero(), sides_.cast<Real>().matrix());
  if (direction.dot(middle(nearest)) > from) return;
  for_cells(threads, [&](std::size_t k, const CellNumber& cell) {
    if (places_[k] != Place::deep) return;
    if (direction.dot(middle(cell.cast<Real>())) <= from) places_[k] = Place::body;
  });
}

void FullCells::find_places(int threads) {
  const auto for_blocks = [&](auto&& f) {
    parallel_chunks(std::ssize(holds_), threads, kBlock, [&](Index first, Index last) {
      for (Index k = first; k < last; ++k) f(k);
    });
  };
  full_ = holds_;
  around(full_, 1, threads, [](int a, int b) { return a & b; });
  body_ = full_;
  around(body_, 1, threads, [](int a, int b) { return a | b; });
  // 2 where loose, 1 where of a body but not full, else 0: of the cell first, then the most of
  // those up to two away.
  near_.resize(holds_.size());
  const std::uint8_t *holds = holds_.data(), *full = full_.data(), *body = body_.data();
  for_blocks([holds, full, body, near = near_.data()](Index k) {
    near[k] = static_cast<std::uint8_t>((2 - body[k] - full[k]) & -holds[k]);
  });
  if (!has_all_) {  // who flew off may be just beyond the margin
    for_cells(threads, [&](std::size_t k, const CellNumber& cell) {
      if ((cell < kMargin || cell >= sides_ - kMargin).any()) near_[k] = 2;
    });
  }
  around(near_, 2, threads, [](int a, int b) { return std::max(a, b); });
  places_.resize(holds_.size());
  for_blocks([body, near = near_.data(), places = places_.data()](Index k) {
    places[k] = static_cast<Place>((3 - near[k]) & -body[k]);
  });
  static_assert(Place{0} == Place::loose && Place{1} == Place::beside && Place{2} == Place::body &&
                Place{3} == Place::deep);
}

void FullCells::find(const PointsView& positions, Real side, int threads) {
  const Index n = positions.cols();
  const Extent body = extent(positions, Eigen::Matrix<Real, 3, 3>::Identity(), threads);
  const Real per_meter = 1 / side;
  const auto number = [&](const Eigen::Array3d& at) -> Eigen::Array3f {
    return (at.cast<Real>() * per_meter).floor();
  };
  const Eigen::Array3f first = number(body.lower) - kMargin;
  const Eigen::Array3f counts = number(body.upper) + kMargin + 1 - first;
  side_ = side;
  first_ = first;
  sides_.setZero();
  cells_.resize(static_cast<std::size_t>(n + kMostLanes));
  const double most = std::min(kMostCells * static_cast<double>(n), 2e9);
  has_all_ = false;
  if (n == 0 || !(counts.cast<double>().prod() <= most)) {
    std::ranges::fill(cells_, 0);
    places_.assign(1, Place::loose);
    return;
  }
  sides_ = counts.cast<Index>();
  strides_ = {1, sides_[0], sides_[0] * sides_[1]};
  const auto size = static_cast<std::size_t>(sides_.prod());
  holds_.assign(size, 0);
  CellBlock block{per_meter, {}, {}, {}};
  for (int axis = 0; axis < 3; ++axis) {
    block.first[axis] = first[axis];
    block.counts[axis] = counts[axis];
    block.strides[axis] = static_cast<std::int32_t>(strides_[axis]);
  }
  const FullCellsKernels& kernels = full_cells_kernels(chosen_isa());
  parallel_chunks(n, threads, kBlock, [&](Index begin, Index end) {
    std::array<std::uint32_t, kBlock + kMostLanes> found;
    kernels.locate(point_block(positions, begin, end), end - begin, block, found.data());
    std::copy_n(found.data(), end - begin, cells_.data() + begin);
    for (Index i = 0; i < end - begin; ++i) {
      __atomic_store_n(&holds_[found[i]], std::uint8_t{1}, __ATOMIC_RELAXED);
    }
  });

  has_all_ = std::exchange(holds_[0], 0) == 0;
  find_places(threads);
}

}  // namespace pbf
