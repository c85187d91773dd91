#include "pbf/render/neighborhoods.hpp"

#include "pbf/core/parallel.hpp"
#include "pbf/render/candidates.hpp"

namespace pbf {

void Neighborhoods::find(const Records& particles, const Vec3& eye, Real s, int threads) {
  const Real farthest = 0.5F * static_cast<Real>(kFarthestCell) * s;
  Records near(particles.size());
  ids_.clear();
  for (Index i = 0; i < particles.size(); ++i) {
    const Vec3 x = Vec3(particles[i].x, particles[i].y, particles[i].z) - eye;
    if (!(x.array().abs() <= farthest).all()) continue;
    near[static_cast<Index>(ids_.size())] = {x.x(), x.y(), x.z(), 0};
    ids_.push_back(static_cast<std::uint32_t>(i));
  }
  const auto count = static_cast<Index>(ids_.size());
  near.resize(count);
  grid_.build(near, s, threads);
  sorted_.resize(count);
  parallel_for(count, threads,
               [&](Index k) { sorted_[k] = near[grid_.order()[static_cast<std::size_t>(k)]]; });
}

void Neighborhoods::for_each(Index count, int threads, const Visit& visit) const {
  const auto is_wanted = [&](std::uint32_t k) { return ids_[grid_.order()[k]] < count; };
  parallel_chunks(sorted_.size(), threads, 4 * kChunk, [&](Index first, Index last) {
    CandidateRoom room;
    for_each_with_candidates(grid_, sorted_, first, last, room, is_wanted,
                             [&](std::uint32_t k, const Candidates& candidates) {
                               visit(ids_[grid_.order()[k]], sorted_[k], candidates);
                             });
  });
}

}  // namespace pbf
