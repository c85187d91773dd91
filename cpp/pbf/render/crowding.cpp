#include "pbf/render/crowding.hpp"

#include "pbf/render/candidates.hpp"
#include "pbf/render/crowding_kernels.hpp"

#include <algorithm>

namespace pbf {
PBF_TABLE_BY_ISA(CrowdingKernels, crowding_kernels, crowding_kernels)
namespace {

/// m of a particle in a body of fluid.
constexpr Real kBodySum = 9;

}  // namespace

void Crowding::find(Neighborhoods& particles, int threads) {
  const CrowdingKernels& kernels = crowding_kernels(chosen_isa());
  const Real inverse_s2 = 1 / (particles.distance() * particles.distance());
  const Records& x = particles.sorted();
  const std::vector<std::uint8_t>& in_body = particles.in_body();
  const auto is_loose = [&](std::uint32_t k) { return in_body[k] == 0; };
  m_.assign(in_body.size(), kBodySum);
  const auto sum = [&](auto k, const Candidates& candidates) {
    m_[k] = std::min(kernels.sum(candidates, x[k], inverse_s2), kBodySum);
  };
  const auto take_largest = [&](auto k, const Candidates& candidates) {
    const Real most = kernels.largest(candidates, x[k], inverse_s2, m_.data());
    particles.particles()[particles.place(k)].w = most / kBodySum;
  };
  for_each_with_candidates(particles, threads, is_loose, sum);
  for_each_with_candidates(particles, threads, is_loose, take_largest);
}

}  // namespace pbf
