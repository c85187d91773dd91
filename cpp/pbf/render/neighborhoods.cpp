#include "pbf/render/neighborhoods.hpp"

#include "pbf/core/isa.hpp"
#include "pbf/core/parallel.hpp"

namespace pbf {
namespace {

/// Room for the candidates around a cell.
class Room {
 public:
  Candidates candidates(CellGrid::Ranges ranges) {
    std::size_t most = kMostLanes;
    for (const Span& range : ranges) most += range.end - range.begin;
    if (entries_.size() < most) {
      entries_.resize(2 * most);
      numbers_.resize(3 * entries_.size());
    }
    Real* x = numbers_.data();
    return {x, x + entries_.size(), x + 2 * entries_.size(), entries_.data(), 0};
  }

 private:
  std::vector<Real> numbers_;
  std::vector<std::uint32_t> entries_;
};

}  // namespace

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
  const Scan& loops = scan(chosen_isa());
  parallel_chunks(sorted_.size(), threads, 4 * kChunk, [&](Index first, Index last) {
    Room room;
    grid_.for_each_cell(
        first, last, [&](std::uint32_t begin, std::uint32_t end, CellGrid::Ranges ranges) {
          Candidates candidates{};
          for (std::uint32_t k = begin; k < end; ++k) {
            const Index i = ids_[grid_.order()[k]];
            if (i >= count) continue;
            if (candidates.count == 0) {
              candidates = room.candidates(ranges);
              candidates.count =
                  loops.collect(sorted_.data(), ranges.data(), ranges.size(), candidates);
            }
            visit(i, sorted_[k], candidates);
          }
        });
  });
}

}  // namespace pbf
