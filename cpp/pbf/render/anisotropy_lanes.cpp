// Compiled once per instruction set (cpp/pbf_render.cmake).
#include "pbf/core/lanes.hpp"
#include "pbf/render/anisotropy_kernels.hpp"

namespace pbf::PBF_ISA_NAMESPACE {
namespace {

constexpr std::uint32_t kVectors = static_cast<std::uint32_t>(kMostLanes) / kLanes;
constexpr int kSums = sizeof(Moments) / sizeof(float);

Moments moments(const Candidates& candidates, const Record& particle, float inverse_s) {
  const Candidates j = candidates;
  const Vec3Lanes x{particle.x, particle.y, particle.z};
  Lanes sums[kSums][kVectors];
  for (auto& sum : sums) {
    for (Lanes& part : sum) part = 0.0F;
  }
  for (std::uint32_t k = 0; k < j.count; k += kMostLanes) {
    for (std::uint32_t vector = 0; vector < kVectors; ++vector) {
      const std::uint32_t at = k + vector * kLanes;
      if (vector > 0 && at >= j.count) break;
      const Vec3Lanes far{load_lanes(j.x + at), load_lanes(j.y + at), load_lanes(j.z + at)};
      const Vec3Lanes r = Lanes(inverse_s) * (far - x);
      const Lanes r2 = dot(r, r);
      const Lanes w = max(1.0F - r2 * sqrt(r2), 0.0F);
      if (!any(w > Lanes(0.0F))) continue;
      const Vec3Lanes wr = w * r;
      const Lanes terms[kSums] = {w,          wr.x,       wr.y,       wr.z,       wr.x * r.x,
                                  wr.y * r.y, wr.z * r.z, wr.x * r.y, wr.x * r.z, wr.y * r.z};
      for (int k_sum = 0; k_sum < kSums; ++k_sum) sums[k_sum][vector] += terms[k_sum];
    }
  }
  float results[kSums];
  for (int k = 0; k < kSums; ++k) {
    float numbers[kMostLanes];
    std::memcpy(numbers, sums[k], sizeof numbers);
    for (int half = kMostLanes / 2; half > 0; half /= 2) {
      for (int lane = 0; lane < half; ++lane) numbers[lane] += numbers[lane + half];
    }
    results[k] = numbers[0];
  }
  Moments result;
  std::memcpy(&result, results, sizeof result);
  return result;
}

}  // namespace

const AnisotropyKernels& anisotropy_kernels() {
  static constexpr AnisotropyKernels table{moments};
  return table;
}

}  // namespace pbf::PBF_ISA_NAMESPACE
