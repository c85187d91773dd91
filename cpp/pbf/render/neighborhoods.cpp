#include "pbf/render/neighborhoods.hpp"

#include "pbf/core/parallel.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <utility>

namespace pbf {
namespace {

using Place = FullCells::Place;

/// Particles that are sorted out at a time.
constexpr Index kBlock = 1 << 12;
/// Farther than anything [m].
constexpr Real kAll = std::numeric_limits<Real>::max();

/// How many of the particles before a block are to be sorted, and how many are deep.
struct Starts {
  Index near = 0, deep = 0;
};

}  // namespace

/// Sets deep particles apart from the others, and picks those to sort.
void Neighborhoods::part(
    const PointsView& positions, const Camera& camera, Deep deep, Place sorted_to, int threads) {
  const Index n = positions.cols();
  const Vec3& eye = camera.eye;
  const Real farthest = 0.5F * static_cast<Real>(kFarthestCell) * s_;
  const auto is_near = [&](const Vec3& x) { return ((x - eye).array().abs() <= farthest).all(); };
  const bool all_near =
      s_ > 0 && cells_.has_all() && is_near(cells_.lower()) && is_near(cells_.upper());
  const auto is_sorted = [&](Index i) {
    return places_[static_cast<std::size_t>(i)] <= sorted_to &&
           (all_near || (s_ > 0 && is_near(positions.col(i))));
  };
  places_.resize(static_cast<std::size_t>(n));
  std::vector<Starts> starts(static_cast<std::size_t>((n + kBlock - 1) / kBlock));
  parallel_chunks(n, threads, kBlock, [&](Index first, Index last) {
    Starts& count = starts[static_cast<std::size_t>(first / kBlock)];
    const auto places = std::span(places_).subspan(first, last - first);
    for (Index i = first; i < last; ++i) places[i - first] = s_ > 0 ? cells_[i] : Place::loose;
    count.deep = std::ranges::count(places, Place::deep);
    if (all_near) {
      count.near = std::ranges::count_if(places, [&](Place at) { return at <= sorted_to; });
      return;
    }
    for (Index i = first; i < last; ++i) count.near += is_sorted(i) ? 1 : 0;
  });
  Starts sum;
  for (Starts& start : starts) {
    sum.near += std::exchange(start.near, sum.near);
    sum.deep += std::exchange(start.deep, sum.deep);
  }
  shallow_ = n - sum.deep;
  particles_.resize(deep == Deep::last ? n : shallow_);
  near_.resize(sum.near);
  ids_.resize(static_cast<std::size_t>(sum.near));
  parallel_chunks(n, threads, kBlock, [&](Index first, Index last) {
    Starts& at = starts[static_cast<std::size_t>(first / kBlock)];
    std::array<std::uint32_t, kBlock> others;  // found without a branch that would be mispredicted
    Index count = 0;
    for (Index i = first; i < last; ++i) {
      others[count] = static_cast<std::uint32_t>(i);
      count += places_[static_cast<std::size_t>(i)] != Place::deep ? 1 : 0;
    }
    Index shallow = first - at.deep;
    for (Index k = 0; k < count; ++k, ++shallow) {
      const Index i = others[k];
      particles_[shallow] = {positions(0, i), positions(1, i), positions(2, i), 1};
      if (!is_sorted(i)) continue;
      const Vec3 x = positions.col(i) - eye;
      const bool in_body = places_[static_cast<std::size_t>(i)] != Place::loose;
      near_[at.near] = {x.x(), x.y(), x.z(), in_body ? 1.0F : 0.0F};
      ids_[static_cast<std::size_t>(at.near++)] = static_cast<std::uint32_t>(shallow);
    }
    if (deep == Deep::left_out) return;
    Index to = shallow_ + at.deep;
    for (Index i = first; i < last; ++i) {
      if (places_[static_cast<std::size_t>(i)] != Place::deep) continue;
      particles_[to++] = {positions(0, i), positions(1, i), positions(2, i), 1};
    }
  });
}

void Neighborhoods::sort(int threads) {
  const Index near = near_.size();
  sorted_.resize(near);
  in_body_.resize(ids_.size());
  if (near == 0) return;
  grid_.build(near_, s_, threads);
  parallel_for(near, threads, [&](Index k) {
    sorted_[k] = near_[grid_.order()[static_cast<std::size_t>(k)]];
    in_body_[static_cast<std::size_t>(k)] = sorted_[k].w == 1 ? 1 : 0;
  });
}

void Neighborhoods::find(const PointsView& positions,
                         const Camera& camera,
                         Real s,
                         Real radius,
                         Deep deep,
                         Sorted sorted,
                         int threads) {
  s_ = s;
  if (s > 0) {
    cells_.find(positions, 0.6F * s, threads);
    // Only large sprites hide what is behind them, and none what the near plane cuts open.
    const Vec3 ahead = (camera.target - camera.eye).normalized();
    const Real open_to = radius < 0.4F * s ? kAll : camera.near + 2 * s;
    cells_.expose(ahead, ahead.dot(camera.eye) + open_to, threads);
  }
  part(positions, camera, deep, sorted == Sorted::shallow ? Place::body : Place::beside, threads);
  sort(threads);
}

}  // namespace pbf
