#include "pbf/render/crowding.hpp"

#include "pbf/render/candidates.hpp"
#include "pbf/render/crowding_kernels.hpp"

#include <algorithm>

namespace pbf {
PBF_TABLE_BY_ISA(CrowdingKernels, crowding_kernels, crowding_kernels)
namespace {

bool is_set(const std::uint8_t& flag) { return __atomic_load_n(&flag, __ATOMIC_RELAXED) != 0; }
void set(std::uint8_t& flag) { __atomic_store_n(&flag, std::uint8_t{1}, __ATOMIC_RELAXED); }

}  // namespace

void Crowding::find(Neighborhoods& particles, int threads) {
  if (particles.sorted().size() == 0) return;
  const CrowdingKernels& kernels = crowding_kernels(chosen_isa());
  const Real inverse_s2 = 1 / (particles.distance() * particles.distance());
  const Records& x = particles.sorted();
  const std::vector<std::uint8_t>& in_body = particles.in_body();
  m_.resize(in_body.size());
  std::ranges::transform(in_body, m_.begin(), [](auto flag) { return flag != 0 ? kBodySum : -1; });
  body_ = in_body;
  wanted_.assign(in_body.size(), 0);

  const auto is_no_body = [&](std::uint32_t k) { return !is_set(body_[k]); };
  const auto is_wanted = [&](std::uint32_t k) { return m_[k] < 0 && is_set(wanted_[k]); };
  const auto sum = [&](auto k, const Candidates& candidates, CandidateRoom& room) {
    m_[k] = std::min(kernels.sum(candidates, x[k], inverse_s2, room.numbers()), kBodySum);
  };
  // Which of these a thread finds marked depends on the others' pace; the result does not.
  const auto sum_and_mark = [&](auto k, const Candidates& candidates, CandidateRoom& room) {
    if (kernels.is_beside(candidates, x[k], inverse_s2, in_body.data())) {
      set(body_[k]);
      return;
    }
    sum(k, candidates, room);
    // Those around a particle in a body are too; of the others all that are around are needed.
    const bool is_body = m_[k] == kBodySum;
    kernels.mark(candidates, room.numbers(), is_body ? kBodyShare : 0,
                 is_body ? body_.data() : wanted_.data());
  };
  const auto take_largest = [&](auto k, const Candidates& candidates, CandidateRoom&) {
    const float most = kernels.largest(candidates, x[k], inverse_s2, m_.data());
    particles.particles()[particles.place(k)].w = most / kBodySum;
  };
  for_each_with_candidates(particles, threads, is_no_body, sum_and_mark);
  for_each_with_candidates(particles, threads, is_wanted, sum);
  for_each_with_candidates(particles, threads, is_no_body, take_largest);
}

}  // namespace pbf
