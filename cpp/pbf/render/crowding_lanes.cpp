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

float sum(const Candidates& j, const Record& particle, float inverse_s2) {
  const Vec3Lanes x{particle.x, particle.y, particle.z};
  Lanes sums[kVectors];
  for (Lanes& s : sums) s = 0.0F;
  for (std::uint32_t k = 0; k < j.count; k += kMostLanes) {
    for (std::uint32_t vector = 0; vector < kVectors; ++vector) {
      const std::uint32_t at = k + vector * kLanes;
      if (vector > 0 && at >= j.count) break;
      const Lanes u = u_of(j, at, x, inverse_s2);
      sums[vector] += u * u;
    }
  }
  float numbers[kMostLanes];
  std::memcpy(numbers, sums, sizeof numbers);
  for (int half = kMostLanes / 2; half > 0; half /= 2) {
    for (int lane = 0; lane < half; ++lane) numbers[lane] += numbers[lane + half];
  }
  return numbers[0] - 1;  // without itself
}

float largest(const Candidates& j, const Record& particle, float inverse_s2, const float* m) {
  const Vec3Lanes x{particle.x, particle.y, particle.z};
  float most = 0;
  for (std::uint32_t k = 0; k < j.count; k += kLanes) {
    const Lanes u = u_of(j, k, x, inverse_s2);
    const Lanes share = min(1.5F * u, 1.0F);
    for (unsigned left = bits(u > Lanes(0.0F)); left != 0; left &= left - 1) {
      const auto lane = static_cast<std::uint32_t>(__builtin_ctz(left));
      most = std::max(most, share.v[lane] * m[j.entry[k + lane] / 4]);
    }
  }
  return most;
}

}  // namespace

const CrowdingKernels& crowding_kernels() {
  static constexpr CrowdingKernels table{sum, largest};
  return table;
}

}  // namespace pbf::PBF_ISA_NAMESPACE
