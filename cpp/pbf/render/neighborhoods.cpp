#include "pbf/render/neighborhoods.hpp"

#include "pbf/core/parallel.hpp"

#include <utility>

namespace pbf {
namespace {

using Place = FullCells::Place;

/// Particles that are sorted out at a time.
constexpr Index kBlock = 1 << 14;

/// How many of the particles before a block are to be sorted, and how many are deep.
struct Starts {
  Index near = 0, deep = 0;
};

}  // namespace

/// Sets deep particles apart from the others, and picks those to sort.
void Neighborhoods::part(const PointsView& positions,
                         const Camera& camera,
                         Real radius,
                         int threads) {
  const Index n = positions.cols();
  const Vec3& eye = camera.eye;
  const Vec3 ahead = (camera.target - eye).normalized();
  const Real hidden_from = radius < 0.4F * s_ ? static_cast<Real>(kInfinity) : camera.near + 2 * s_;
  const Real farthest = 0.5F * static_cast<Real>(kFarthestCell) * s_;
  const auto is_hidden = [&](Index i) { return ahead.dot(positions.col(i) - eye) > hidden_from; };
  const auto is_near = [&](Index i) {
    return s_ > 0 && ((positions.col(i) - eye).array().abs() <= farthest).all();
  };
  if (s_ > 0) cells_.find(positions, 0.6F * s_, threads);
  places_.resize(static_cast<std::size_t>(n));
  std::vector<Starts> starts(static_cast<std::size_t>((n + kBlock - 1) / kBlock));
  parallel_chunks(n, threads, kBlock, [&](Index first, Index last) {
    Starts& count = starts[static_cast<std::size_t>(first / kBlock)];
    for (Index i = first; i < last; ++i) {
      Place place = s_ > 0 ? cells_[i] : Place::open;
      if (place == Place::deep && !is_hidden(i)) place = Place::full;
      places_[static_cast<std::size_t>(i)] = place;
      count.deep += place == Place::deep ? 1 : 0;
      count.near += place != Place::deep && is_near(i) ? 1 : 0;
    }
  });
  Starts sum;
  for (Starts& start : starts) {
    sum.near += std::exchange(start.near, sum.near);
    sum.deep += std::exchange(start.deep, sum.deep);
  }
  deep_ = sum.deep;
  particles_.resize(n);
  near_.resize(sum.near);
  ids_.resize(static_cast<std::size_t>(sum.near));
  parallel_chunks(n, threads, kBlock, [&](Index first, Index last) {
    Starts& at = starts[static_cast<std::size_t>(first / kBlock)];
    Index shallow = first - at.deep;
    Index deep = n - sum.deep + at.deep;
    for (Index i = first; i < last; ++i) {
      const Record particle{positions(0, i), positions(1, i), positions(2, i), 1};
      const Place place = places_[static_cast<std::size_t>(i)];
      if (place == Place::deep) {
        particles_[deep++] = particle;
        continue;
      }
      if (is_near(i)) {
        const Vec3 x = positions.col(i) - eye;
        near_[at.near] = {x.x(), x.y(), x.z(), place == Place::full ? 1.0F : 0.0F};
        ids_[static_cast<std::size_t>(at.near++)] = static_cast<std::uint32_t>(shallow);
      }
      particles_[shallow++] = particle;
    }
  });
}

void Neighborhoods::sort(int threads) {
  const Index near = near_.size();
  sorted_.resize(near);
  full_.resize(ids_.size());
  if (near == 0) return;
  grid_.build(near_, s_, threads);
  parallel_for(near, threads, [&](Index k) {
    sorted_[k] = near_[grid_.order()[static_cast<std::size_t>(k)]];
    full_[static_cast<std::size_t>(k)] = sorted_[k].w == 1 ? 1 : 0;
  });
}

void Neighborhoods::find(
    const PointsView& positions, const Camera& camera, Real s, Real radius, int threads) {
  s_ = s;
  part(positions, camera, radius, threads);
  sort(threads);
}

}  // namespace pbf
