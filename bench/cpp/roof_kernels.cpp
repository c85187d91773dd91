// Compiled once per instruction set. Nothing here may call an inline function of a header that is
// not an intrinsic: the linker keeps one copy of it, perhaps one that this machine cannot run.
#include "roof_kernels.hpp"

#include <utility>
#ifdef __AVX2__
#include <immintrin.h>
#endif

namespace pbf::bench {
namespace {

#if defined(__AVX512F__)
constexpr int kLanes = 16;
#elif defined(__AVX2__)
constexpr int kLanes = 8;
#else
constexpr int kLanes = 4;
#endif
using Lanes [[gnu::vector_size(4 * kLanes)]] = float;

// Two units with a latency of four cycles are busy with eight chains; twelve and the two constants
// fit into sixteen registers.
constexpr int kChains = 12;

float sum(Lanes v) {
  float total = 0;
  for (int lane = 0; lane < kLanes; ++lane) total += v[lane];
  return total;
}

// Chains that start alike would be computed once.
void start(Lanes (&x)[kChains]) {
  for (int k = 0; k < kChains; ++k) x[k] = Lanes{} + static_cast<float>(k);
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
      x[k] = x[k] * a;
      x[k + 1] = x[k + 1] + b;
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

/// Records j[0], j[4], … side by side: four lanes each.
Lanes every_fourth(const float* records, const std::uint32_t* j) {
  const auto record = [&](int k) { return records + 4 * std::size_t{j[k]}; };
#if defined(__AVX512F__)
  __m512 row = _mm512_castps128_ps512(_mm_load_ps(record(0)));
  row = _mm512_insertf32x4(row, _mm_load_ps(record(4)), 1);
  row = _mm512_insertf32x4(row, _mm_load_ps(record(8)), 2);
  return _mm512_insertf32x4(row, _mm_load_ps(record(12)), 3);
#elif defined(__AVX2__)
  const __m256 row = _mm256_castps128_ps256(_mm_load_ps(record(0)));
  return _mm256_insertf128_ps(row, _mm_load_ps(record(4)), 1);
#else
  return *reinterpret_cast<const Lanes*>(record(0));
#endif
}

/// In each block of four lanes the elements p0 to p3, of a where p < 4, of b from there on.
template <int p0, int p1, int p2, int p3, std::size_t... kLane>
Lanes shuffle(Lanes a, Lanes b, std::index_sequence<kLane...>) {
  constexpr int p[] = {p0, p1, p2, p3};
  return __builtin_shufflevector(
      a, b, (static_cast<int>(kLane / 4 * 4) + p[kLane % 4] % 4 + p[kLane % 4] / 4 * kLanes)...);
}

float load_records(const float* records, const std::uint32_t* index, std::int64_t count) {
  constexpr std::make_index_sequence<kLanes> kAll;
  Lanes x{}, y{}, z{}, w{};
  for (std::int64_t k = 0; k < count; k += kLanes) {
    const Lanes r0 = every_fourth(records, index + k), r1 = every_fourth(records, index + k + 1),
                r2 = every_fourth(records, index + k + 2),
                r3 = every_fourth(records, index + k + 3);
    const Lanes xy01 = shuffle<0, 4, 1, 5>(r0, r1, kAll), xy23 = shuffle<0, 4, 1, 5>(r2, r3, kAll);
    const Lanes zw01 = shuffle<2, 6, 3, 7>(r0, r1, kAll), zw23 = shuffle<2, 6, 3, 7>(r2, r3, kAll);
    x += shuffle<0, 1, 4, 5>(xy01, xy23, kAll);
    y += shuffle<2, 3, 6, 7>(xy01, xy23, kAll);
    z += shuffle<0, 1, 4, 5>(zw01, zw23, kAll);
    w += shuffle<2, 3, 6, 7>(zw01, zw23, kAll);
  }
  return sum(x) + 2 * sum(y) + 3 * sum(z) + 4 * sum(w);
}

#ifdef __AVX2__
Lanes gather(const float* records, const std::uint32_t* j) {
#ifdef __AVX512F__
  return _mm512_i32gather_ps(_mm512_slli_epi32(_mm512_loadu_si512(j), 2), records, 4);
#else
  const __m256i at = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(j));
  return _mm256_i32gather_ps(records, _mm256_slli_epi32(at, 2), 4);
#endif
}

float gather_records(const float* records, const std::uint32_t* index, std::int64_t count) {
  Lanes x{}, y{}, z{}, w{};
  for (std::int64_t k = 0; k < count; k += kLanes) {
    x += gather(records, index + k);
    y += gather(records + 1, index + k);
    z += gather(records + 2, index + k);
    w += gather(records + 3, index + k);
  }
  return sum(x) + 2 * sum(y) + 3 * sum(z) + 4 * sum(w);
}
#endif

}  // namespace

const RoofKernels PBF_ROOF_KERNELS{
    .isa = PBF_ROOF_ISA,
    .fused = fused,
    .fused_flops = 2.0 * kChains * kLanes,
    .separate = separate,
    .separate_flops = 1.0 * kChains * kLanes,
    .triad = triad,
    .load_records = load_records,
#ifdef __AVX2__
    .gather_records = gather_records,
#endif
};

}  // namespace pbf::bench
