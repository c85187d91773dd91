// Compiled once per instruction set (cpp/pbf_render.cmake).
#include "pbf/core/lanes.hpp"
#include "pbf/render/crowding_kernels.hpp"

namespace pbf::PBF_ISA_NAMESPACE {
namespace {

constexpr std::uint32_t kVectors = static_cast<std::uint32_t>(kMostLanes) / kLanes;

/// 1 - |x_j - x|²/s² where that is positive, of the candidates from k on. Those behind the last are
/// far away.
PBF_INLINE Lanes u_of(const Candidates& j, std::uint32_t k, const Vec3Lanes& x, Lanes inverse_s2) {
  const Vec3Lanes r = Vec3Lanes{load_lanes(j.x + k), load_lanes(j.y + k), load_lanes(j.z + k)} - x;
  return max(1.0F - dot(r, r) * inverse_s2, 0.0F);
}

/// Calls f(k) for the lanes that are set. (Other threads may set the same flags, to the same.)
template <class F>
PBF_INLINE void for_each_lane(Mask mask, F&& f) {
  for (unsigned left = bits(mask); left != 0; left &= left - 1) {
    f(static_cast<std::uint32_t>(__builtin_ctz(left)));
  }
}
PBF_INLINE void set(std::uint8_t* flag) {
  __atomic_store_n(flag, std::uint8_t{1}, __ATOMIC_RELAXED);
}

bool is_beside(const Candidates& candidates,
               const Record& particle,
               float inverse_s2,
               const std::uint8_t* flags) {
  const Candidates j = candidates;
  const Vec3Lanes x{particle.x, particle.y, particle.z};
  bool found = false;
  const auto look = [&](std::uint32_t k) PBF_LAMBDA_INLINE {
    for_each_lane(u_of(j, k, x, inverse_s2) > Lanes(kBodyShare),
                  [&](std::uint32_t lane)
                      PBF_LAMBDA_INLINE { found |= flags[j.entry[k + lane] / 4] != 0; });
  };
  // From the middle outwards, where the nearest rows of cells are.
  const std::uint32_t vectors = (j.count + kLanes - 1) / kLanes;
  for (std::uint32_t below = vectors / 2, above = below; !found && above < vectors; ++above) {
    look(above * kLanes);
    if (below > 0) look(--below * kLanes);
  }
  return found;
}

float sum(const Candidates& candidates, const Record& particle, float inverse_s2, float* u) {
  const Candidates j = candidates;  // as numbers: no store changes them
  const Vec3Lanes x{particle.x, particle.y, particle.z};
  Lanes sums[kVectors];
  for (Lanes& s : sums) s = 0.0F;
  for (std::uint32_t k = 0; k < j.count; k += kMostLanes) {
    for (std::uint32_t vector = 0; vector < kVectors; ++vector) {
      const std::uint32_t at = k + vector * kLanes;
      if (vector > 0 && at >= j.count) break;
      const Lanes u_j = u_of(j, at, x, inverse_s2);
      store(u + at, u_j);
      sums[vector] += u_j * u_j;
    }
  }
  float numbers[kMostLanes];
  std::memcpy(numbers, sums, sizeof numbers);
  for (int half = kMostLanes / 2; half > 0; half /= 2) {
    for (int lane = 0; lane < half; ++lane) numbers[lane] += numbers[lane + half];
  }
  return numbers[0] - 1;  // without itself
}

void mark(const Candidates& candidates, const float* u, float beyond, std::uint8_t* flags) {
  const Candidates j = candidates;
  for (std::uint32_t k = 0; k < j.count; k += kLanes) {
    for_each_lane(load_lanes(u + k) > Lanes(beyond), [&](std::uint32_t lane) PBF_LAMBDA_INLINE {
      set(flags + j.entry[k + lane] / 4);
    });
  }
}

float largest(const Candidates& candidates,
              const Record& particle,
              float inverse_s2,
              const float* m) {
  const Candidates j = candidates;
  const Vec3Lanes x{particle.x, particle.y, particle.z};
  float most = 0;
  for (std::uint32_t k = 0; k < j.count; k += kLanes) {
    const Lanes u = u_of(j, k, x, inverse_s2);
    const Lanes share = min(1.5F * u, 1.0F);
    for_each_lane(u > Lanes(0.0F), [&](std::uint32_t lane) PBF_LAMBDA_INLINE {
      const float crowded = share.v[lane] * m[j.entry[k + lane] / 4];
      most = most < crowded ? crowded : most;
    });
  }
  return most;
}

}  // namespace

const CrowdingKernels& crowding_kernels() {
  static constexpr CrowdingKernels table{is_beside, sum, mark, largest};
  return table;
}

}  // namespace pbf::PBF_ISA_NAMESPACE
