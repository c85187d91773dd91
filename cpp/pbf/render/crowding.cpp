#include "pbf/render/crowding.hpp"

#include "pbf/core/parallel.hpp"
#include "pbf/render/crowding_kernels.hpp"

#include <array>
#include <utility>

namespace pbf {
PBF_TABLE_BY_ISA(CrowdingKernels, crowding_kernels, crowding_kernels)
namespace {

/// Particles that are sorted out at a time.
constexpr Index kBlock = 1 << 14;

/// What a thread needs to look at a cell.
struct Scratch {
  std::vector<float> numbers;
  std::vector<std::uint32_t> entries;
  Candidates candidates(CellGrid::Ranges ranges) {
    std::size_t room = kMostLanes;
    for (const Span& range : ranges) room += range.end - range.begin;
    if (entries.size() < room) {
      entries.resize(2 * room);
      numbers.resize(4 * entries.size());
    }
    float* x = numbers.data();
    return {x, x + entries.size(), x + 2 * entries.size(), entries.data(), 0};
  }
  float* u() { return numbers.data() + 3 * entries.size(); }
};
thread_local Scratch scratch;

bool is_set(const std::uint8_t& flag) { return __atomic_load_n(&flag, __ATOMIC_RELAXED) != 0; }

}  // namespace

void Crowding::sort(const PointsView& positions, const Vec3& eye, Real s, int threads) {
  const Index n = positions.cols();
  const Real farthest = 0.5F * static_cast<Real>(kFarthestCell) * s;
  const auto is_near = [&](Index i) {
    return s > 0 && ((positions.col(i) - eye).array().abs() <= farthest).all();
  };
  particles_.resize(n);
  std::vector<Index> places(static_cast<std::size_t>((n + kBlock - 1) / kBlock));
  parallel_chunks(n, threads, kBlock, [&](Index first, Index last) {
    Index& count = places[static_cast<std::size_t>(first / kBlock)];
    for (Index i = first; i < last; ++i) {
      particles_[i] = {positions(0, i), positions(1, i), positions(2, i), 1};
      count += is_near(i) ? 1 : 0;
    }
  });
  Index near = 0;
  for (Index& place : places) near += std::exchange(place, near);
  near_.resize(near);
  ids_.resize(static_cast<std::size_t>(near));
  if (near == 0) return;
  parallel_chunks(n, threads, kBlock, [&](Index first, Index last) {
    Index& place = places[static_cast<std::size_t>(first / kBlock)];
    for (Index i = first; i < last; ++i) {
      if (!is_near(i)) continue;
      const Vec3 x = positions.col(i) - eye;
      near_[place] = {x.x(), x.y(), x.z(), 0};
      ids_[static_cast<std::size_t>(place++)] = static_cast<std::uint32_t>(i);
    }
  });
  grid_.build(near_, s, threads);
  sorted_.resize(near);
  parallel_for(near, threads, [&](Index k) {
    sorted_[k] = near_[grid_.order()[static_cast<std::size_t>(k)]];
    sorted_[k].w = -1;
  });
  body_.assign(static_cast<std::size_t>(near), 0);
  wanted_.assign(static_cast<std::size_t>(near), 0);
}

template <class Wanted, class F>
void Crowding::for_each(int threads, Wanted&& wanted, F&& f) const {
  const Scan& loops = scan(chosen_isa());
  parallel_chunks(sorted_.size(), threads, 4 * kChunk, [&](Index first, Index last) {
    grid_.for_each_cell(
        first, last, [&](std::uint32_t begin, std::uint32_t end, CellGrid::Ranges ranges) {
          Candidates candidates{};
          for (std::uint32_t k = begin; k < end; ++k) {
            if (!wanted(k)) continue;
            if (candidates.count == 0) {
              candidates = scratch.candidates(ranges);
              candidates.count =
                  loops.collect(sorted_.data(), ranges.data(), ranges.size(), candidates);
            }
            f(k, candidates);
          }
        });
  });
}

void Crowding::find_crowding(Real s, int threads) {
  const CrowdingKernels& kernels = crowding_kernels(chosen_isa());
  const Real inverse_s2 = 1 / (s * s);
  const auto is_no_body = [&](std::uint32_t k) { return !is_set(body_[k]); };
  const auto is_wanted = [&](std::uint32_t k) { return is_set(wanted_[k]); };
  const auto sum = [&](std::uint32_t k, const Candidates& candidates) {
    const Record& particle = sorted_[k];
    sorted_[k].w = std::min(kernels.sum(candidates, particle, inverse_s2, scratch.u()), kBodySum);
  };
  // Which of these a thread finds marked depends on the others' pace; the result does not.
  for_each(threads, is_no_body, [&](std::uint32_t k, const Candidates& candidates) {
    sum(k, candidates);
    if (sorted_[k].w == kBodySum) kernels.mark(candidates, scratch.u(), body_.data());
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

void Crowding::find(const PointsView& positions, const Vec3& eye, Real s, int threads) {
  sort(positions, eye, s, threads);
  if (near_.size() == 0) return;
  find_crowding(s, threads);
}

}  // namespace pbf
