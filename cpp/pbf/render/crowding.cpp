#include "pbf/render/crowding.hpp"

#include "pbf/core/parallel.hpp"
#include "pbf/render/candidates.hpp"
#include "pbf/render/crowding_kernels.hpp"

#include <array>
#include <utility>

namespace pbf {
PBF_TABLE_BY_ISA(CrowdingKernels, crowding_kernels, crowding_kernels)
namespace {

using Place = FullCells::Place;

/// Particles that are sorted out at a time.
constexpr Index kBlock = 1 << 14;

thread_local CandidateRoom room;

/// How many of the particles before a block are to be looked at, and how many are deep.
struct Starts {
  Index near = 0, deep = 0;
};

bool is_set(const std::uint8_t& flag) { return __atomic_load_n(&flag, __ATOMIC_RELAXED) != 0; }
void set(std::uint8_t& flag) { __atomic_store_n(&flag, std::uint8_t{1}, __ATOMIC_RELAXED); }

}  // namespace

void Crowding::part(
    const PointsView& positions, const Camera& camera, Real s, Real radius, int threads) {
  const Index n = positions.cols();
  const Vec3& eye = camera.eye;
  const Vec3 ahead = (camera.target - eye).normalized();
  const Real hidden_from = radius < 0.4F * s ? static_cast<Real>(kInfinity) : camera.near + 2 * s;
  const Real farthest = 0.5F * static_cast<Real>(kFarthestCell) * s;
  const auto is_hidden = [&](Index i) { return ahead.dot(positions.col(i) - eye) > hidden_from; };
  const auto is_near = [&](Index i) {
    return s > 0 && ((positions.col(i) - eye).array().abs() <= farthest).all();
  };
  if (s > 0) cells_.find(positions, 0.6F * s, threads);
  places_.resize(static_cast<std::size_t>(n));
  std::vector<Starts> starts(static_cast<std::size_t>((n + kBlock - 1) / kBlock));
  parallel_chunks(n, threads, kBlock, [&](Index first, Index last) {
    Starts& count = starts[static_cast<std::size_t>(first / kBlock)];
    for (Index i = first; i < last; ++i) {
      Place place = s > 0 ? cells_[i] : Place::open;
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
        near_[at.near] = {x.x(), x.y(), x.z(), place == Place::full ? kBodySum : -1};
        ids_[static_cast<std::size_t>(at.near++)] = static_cast<std::uint32_t>(shallow);
      }
      particles_[shallow++] = particle;
    }
  });
}

void Crowding::sort(Real s, int threads) {
  const Index near = near_.size();
  grid_.build(near_, s, threads);
  sorted_.resize(near);
  full_.resize(ids_.size());
  parallel_for(near, threads, [&](Index k) {
    sorted_[k] = near_[grid_.order()[static_cast<std::size_t>(k)]];
    full_[static_cast<std::size_t>(k)] = sorted_[k].w == kBodySum ? 1 : 0;
  });
  body_ = full_;
  wanted_.assign(ids_.size(), 0);
}

template <class Wanted, class F>
void Crowding::for_each(int threads, Wanted&& wanted, F&& f) const {
  parallel_chunks(sorted_.size(), threads, 4 * kChunk, [&](Index first, Index last) {
    while (first < last && !wanted(static_cast<std::uint32_t>(first))) ++first;
    while (first < last && !wanted(static_cast<std::uint32_t>(last - 1))) --last;
    for_each_with_candidates(grid_, sorted_, first, last, room, wanted, f);
  });
}

void Crowding::find_crowding(Real s, int threads) {
  const CrowdingKernels& kernels = crowding_kernels(chosen_isa());
  const Real inverse_s2 = 1 / (s * s);
  const auto is_no_body = [&](std::uint32_t k) { return !is_set(body_[k]); };
  const auto is_wanted = [&](std::uint32_t k) { return is_set(wanted_[k]); };
  const auto sum = [&](std::uint32_t k, const Candidates& candidates) {
    const Record& particle = sorted_[k];
    sorted_[k].w =
        std::min(kernels.sum(candidates, particle, inverse_s2, room.numbers()), kBodySum);
  };
  // Which of these a thread finds marked depends on the others' pace; the result does not.
  for_each(threads, is_no_body, [&](std::uint32_t k, const Candidates& candidates) {
    if (kernels.is_beside(candidates, sorted_[k], inverse_s2, full_.data())) {
      set(body_[k]);
      return;
    }
    sum(k, candidates);
    if (sorted_[k].w == kBodySum) kernels.mark(candidates, room.numbers(), body_.data());
  });
  for_each(threads, is_no_body, [&](std::uint32_t k, const Candidates& candidates) {
    kernels.mark_unknown(candidates, sorted_[k], inverse_s2, sorted_.data(), wanted_.data());
  });
  for_each(threads, is_wanted, sum);
  for_each(threads, is_no_body, [&](std::uint32_t k, const Candidates& candidates) {
    const float most = kernels.largest(candidates, sorted_[k], inverse_s2, sorted_.data());
    particles_[ids_[grid_.order()[k]]].w = most / kBodySum;
  });
}

void Crowding::find(
    const PointsView& positions, const Camera& camera, Real s, Real radius, int threads) {
  part(positions, camera, s, radius, threads);
  if (near_.size() == 0) return;
  sort(s, threads);
  find_crowding(s, threads);
}

}  // namespace pbf
