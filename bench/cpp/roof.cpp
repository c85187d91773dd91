#include "roof.hpp"

#include "pbf/core/parallel.hpp"
#include "pbf/core/stopwatch.hpp"

#include <benchmark/benchmark.h>

#include "roof_kernels.hpp"
#include <algorithm>
#include <map>
#include <memory>
#include <random>
#include <vector>

namespace pbf::bench {
namespace {

constexpr double kMillisecondsPerRoof = 100;

const RoofKernels& best_kernels() {
#ifdef __x86_64__
  if (__builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512dq"))
    return roof_kernels_x86_64_v4;
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
    return roof_kernels_x86_64_v3;
#endif
  return roof_kernels_baseline;
}

/// The most units of work per second over repeats in which each thread calls f(repeat, thread) and
/// does `work` of them. A call should take a millisecond or two: long beside the waking of a thread,
/// short beside what else the machine has to do.
template <class F>
double best_rate(double work, int threads, F&& f) {
  double best = 0, total_ms = 0;
  for (Index repeat = 0; total_ms < kMillisecondsPerRoof; ++repeat) {
    double ms = 0;
    {
      const Stopwatch stopwatch(ms);
      parallel_chunks(threads, threads, 1, [&](Index thread, Index) { f(repeat, thread); });
    }
    best = std::max(best, 1e3 * work * threads / ms);
    total_ms += ms;
  }
  return best;
}

double flops(decltype(RoofKernels::fused) loop, double flops_per_round, int threads) {
  constexpr std::int64_t kRounds = 1'000'000;
  // Factor and term neither overflow nor come to subnormal numbers, which are slow.
  return best_rate(kRounds * flops_per_round, threads, [&](Index, Index) {
    benchmark::DoNotOptimize(loop(kRounds, 0.9999999F, 1.0F));
  });
}

std::int64_t last_cache() {
  std::int64_t size = 0;
  for (const auto& cache : benchmark::CPUInfo::Get().caches)
    size = std::max<std::int64_t>(size, cache.size);
  return size;
}

double bandwidth(const RoofKernels& kernels, int threads) {
  // Arrays four times the last cache, as STREAM asks [McC95], within reason; a repeat walks through
  // the next slice of them.
  constexpr std::int64_t kSlices = 16;
  const auto bytes = std::clamp<std::int64_t>(4 * last_cache(), 64 << 20, 256 << 20);
  const std::int64_t part = bytes / static_cast<std::int64_t>(sizeof(float)) / kSlices / threads;
  const std::int64_t parts = kSlices * threads;
  const auto array = [&] { return std::make_unique_for_overwrite<float[]>(part * parts); };
  const auto a = array(), b = array(), c = array();
  parallel_chunks(parts, threads, 1, [&](Index k, Index) {
    std::fill_n(&a[k * part], part, 0.0F);
    std::fill_n(&b[k * part], part, 1.0F);
    std::fill_n(&c[k * part], part, 2.0F);
  });
  // Four numbers each: a cache line of a is read before it is written, and model.hpp counts that as
  // well. STREAM counts three, so its figure for this is a quarter less.
  const double work = 4.0 * sizeof(float) * static_cast<double>(part);
  return best_rate(work, threads, [&](Index repeat, Index thread) {
    const std::int64_t first = part * (repeat % kSlices * threads + thread);
    kernels.triad(part, 3.0F, &b[first], &c[first], &a[first]);
    benchmark::ClobberMemory();
  });
}

/// Loads from an array of `size` records.
double record_rate(decltype(RoofKernels::load_records) loop, std::uint32_t size, int threads) {
  constexpr int kCount = 1 << 13;
  constexpr int kPasses = 800;
  struct alignas(16) Record {
    float x, y, z, w;
  };
  const std::vector<Record> records(size, Record{1, 2, 3, 4});
  std::mt19937 random;  // its numbers are the same everywhere
  std::vector<std::uint32_t> index(kCount);
  for (auto& j : index) j = static_cast<std::uint32_t>(random()) % size;
  return best_rate(kCount * kPasses, threads, [&](Index, Index) {
    for (int pass = 0; pass < kPasses; ++pass)
      benchmark::DoNotOptimize(loop(&records[0].x, index.data(), kCount));
  });
}

Roof measured(int threads) {
  const RoofKernels& kernels = best_kernels();
  constexpr std::uint32_t kFirstCache = 1 << 9;    // records: 8 KiB
  constexpr std::uint32_t kSecondCache = 1 << 13;  // 128 KiB
  return {
      .isa = kernels.isa,
      .fused_flops = flops(kernels.fused, kernels.fused_flops, threads),
      .separate_flops = flops(kernels.separate, kernels.separate_flops, threads),
      .bandwidth = bandwidth(kernels, threads),
      .last_cache = static_cast<double>(last_cache()),
      .record_loads = record_rate(kernels.load_records, kFirstCache, threads),
      .record_loads_l2 = record_rate(kernels.load_records, kSecondCache, threads),
      .record_gathers =
          kernels.gather_records ? record_rate(kernels.gather_records, kFirstCache, threads) : 0,
  };
}

}  // namespace

const Roof& roof_of(int threads) {
  static std::map<int, Roof> roofs;
  const auto found = roofs.find(threads);
  return found != roofs.end() ? found->second
                              : roofs.emplace(threads, measured(threads)).first->second;
}

}  // namespace pbf::bench
