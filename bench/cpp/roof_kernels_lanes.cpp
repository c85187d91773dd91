// Compiled once per instruction set (bench/CMakeLists.txt).
#include "pbf/core/lanes.hpp"

#include "roof_kernels.hpp"

namespace pbf::PBF_ISA_NAMESPACE {
namespace {

// Two units with a latency of four cycles are busy with eight chains; twelve and the two constants
// fit into sixteen registers.
constexpr int kChains = 12;

float sum(Lanes a) {
  float total = 0;
  for (int lane = 0; lane < kLanes; ++lane) total += a.v[lane];
  return total;
}

// Chains that start alike would be computed once.
void start(Lanes (&x)[kChains]) {
  for (int k = 0; k < kChains; ++k) x[k] = static_cast<Real>(k);
}

float sum(const Lanes (&x)[kChains]) {
  float total = 0;
  for (const Lanes& chain : x) total += sum(chain);
  return total;
}

float fused(std::int64_t rounds, float a, float b) {
  Lanes x[kChains];
  start(x);
  for (std::int64_t round = 0; round < rounds; ++round) {
    for (Lanes& chain : x) chain = chain * a + b;
  }
  return sum(x);
}

float separate(std::int64_t rounds, float a, float b) {
  Lanes x[kChains];
  start(x);
  for (std::int64_t round = 0; round < rounds; ++round) {
    for (int k = 0; k < kChains; k += 2) {
      x[k] *= a;
      x[k + 1] += b;
    }
  }
  return sum(x);
}

void triad(std::int64_t n,
           float s,
           const float* __restrict b,
           const float* __restrict c,
           float* __restrict a) {
  for (std::int64_t k = 0; k < n; ++k) a[k] = b[k] + s * c[k];
}

float sum(const RecordLanes& a) {
  return sum(a.xyz.x) + 2 * sum(a.xyz.y) + 3 * sum(a.xyz.z) + 4 * sum(a.w);
}

float load_records(const Record* records, const std::uint32_t* entries, std::int64_t count) {
  RecordLanes total{{0, 0, 0}, 0};
  for (std::int64_t k = 0; k < count; k += kLanes) {
    const RecordLanes at = gather(records, entries + k);
    total.xyz += at.xyz;
    total.w += at.w;
  }
  return sum(total);
}

#if defined(__AVX2__)
PBF_INLINE Lanes gather_numbers(const Real* numbers, const std::uint32_t* entries) {
#if defined(__AVX512F__)
  return {_mm512_i32gather_ps(load<__m512i>(entries), numbers, sizeof(Real))};
#else
  return {_mm256_i32gather_ps(numbers, load<__m256i>(entries), sizeof(Real))};
#endif
}

float gather_records(const Record* records, const std::uint32_t* entries, std::int64_t count) {
  RecordLanes total{{0, 0, 0}, 0};
  for (std::int64_t k = 0; k < count; k += kLanes) {
    total.xyz.x += gather_numbers(&records->x, entries + k);
    total.xyz.y += gather_numbers(&records->y, entries + k);
    total.xyz.z += gather_numbers(&records->z, entries + k);
    total.w += gather_numbers(&records->w, entries + k);
  }
  return sum(total);
}
#endif

}  // namespace

const bench::RoofKernels& roof_kernels() {
  static constexpr bench::RoofKernels table {
    .fused = fused, .fused_flops = 2.0 * kChains * kLanes, .separate = separate,
    .separate_flops = 1.0 * kChains * kLanes, .triad = triad, .load_records = load_records,
#if defined(__AVX2__)
    .gather_records = gather_records,
#endif
  };
  return table;
}

}  // namespace pbf::PBF_ISA_NAMESPACE
