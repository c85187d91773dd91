#include "roof.hpp"

#include "pbf/core/isa.hpp"

#include <benchmark/benchmark.h>

#include "roof_kernels.hpp"
#include <algorithm>
#include <barrier>
#include <chrono>
#include <map>
#include <memory>
#include <random>
#include <thread>
#include <vector>
#ifdef __linux__
#include <sched.h>
#endif

namespace pbf {

PBF_TABLE_BY_ISA(bench::RoofKernels, roof_kernels, roof_kernels)

namespace bench {
namespace {

constexpr std::chrono::milliseconds kTimePerRoof{100};

/// Binds the calling thread to a processor of its own if there is one for every thread. Else, and
/// where a system has no such call, its scheduler knows better, which cores share what among them.
void bind_to_processor([[maybe_unused]] int thread, [[maybe_unused]] int threads) {
#ifdef __linux__
  cpu_set_t allowed, own;
  sched_getaffinity(0, sizeof allowed, &allowed);
  if (CPU_COUNT(&allowed) != threads) return;
  int processor = 0;
  for (int skip = thread; skip > 0 || !CPU_ISSET(processor, &allowed); ++processor)
    skip -= CPU_ISSET(processor, &allowed) ? 1 : 0;
  CPU_ZERO(&own);
  CPU_SET(processor, &own);
  sched_setaffinity(0, sizeof own, &own);
#endif
}

/// Calls f(thread) in so many new threads at once.
template <class F>
void in_threads(int threads, F&& f) {
  std::vector<std::jthread> running;
  running.reserve(static_cast<std::size_t>(threads));
  for (int thread = 0; thread < threads; ++thread) {
    running.emplace_back([&f, thread, threads] {
      bind_to_processor(thread, threads);
      f(thread);
    });
  }
}

/// The most units of work per second over repeats in which each thread calls f(repeat, thread) and
/// does `work` of them. A call should take some tenths of a millisecond: long beside the meeting of
/// the threads at a barrier, short beside the time slice that something else on the machine gets.
template <class F>
double best_rate(double work, int threads, F&& f) {
  using Clock = std::chrono::steady_clock;
  double best = 0;
  bool enough = false;
  Clock::time_point start = Clock::now();
  const Clock::time_point end = start + kTimePerRoof;
  std::barrier all_done(threads, [&]() noexcept {
    const Clock::time_point now = Clock::now();
    best = std::max(best, work * threads / std::chrono::duration<double>(now - start).count());
    enough = now >= end;
    start = now;
  });
  in_threads(threads, [&](int thread) {
    std::int64_t repeat = 0;
    do {
      f(repeat++, thread);
      all_done.arrive_and_wait();
    } while (!enough);
  });
  return best;
}

double flops(decltype(RoofKernels::fused) loop, double flops_per_round, int threads) {
  constexpr std::int64_t kRounds = 200'000;
  // Factor and term neither overflow nor come to subnormal numbers, which are slow.
  return best_rate(kRounds * flops_per_round, threads, [&](std::int64_t, int) {
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
  constexpr std::int64_t kSlices = 64;
  const auto bytes = std::clamp<std::int64_t>(4 * last_cache(), 64 << 20, 256 << 20);
  const std::int64_t part = bytes / static_cast<std::int64_t>(sizeof(float)) / kSlices / threads;
  const auto array = [&] {
    return std::make_unique_for_overwrite<float[]>(kSlices * threads * part);
  };
  const auto a = array(), b = array(), c = array();
  const auto first = [&](std::int64_t slice, int thread) {
    return (slice * threads + thread) * part;
  };
  // Filled by the thread that will use them: its memory is the nearest.
  in_threads(threads, [&](int thread) {
    for (std::int64_t slice = 0; slice < kSlices; ++slice) {
      std::fill_n(&a[first(slice, thread)], part, 0.0F);
      std::fill_n(&b[first(slice, thread)], part, 1.0F);
      std::fill_n(&c[first(slice, thread)], part, 2.0F);
    }
  });
  // Four numbers each: a cache line of a is read before it is written, and model.hpp counts that as
  // well. STREAM counts three, so its figure for this is a quarter less.
  const double work = 4.0 * sizeof(float) * static_cast<double>(part);
  return best_rate(work, threads, [&](std::int64_t repeat, int thread) {
    const std::int64_t k = first(repeat % kSlices, thread);
    kernels.triad(part, 3.0F, &b[k], &c[k], &a[k]);
    benchmark::ClobberMemory();
  });
}

/// Loads from an array of `size` records.
double record_rate(decltype(RoofKernels::load_records) loop, std::uint32_t size, int threads) {
  constexpr int kCount = 1 << 13;
  constexpr int kPasses = 100;
  const std::vector<Record> records(size, Record{1, 2, 3, 4});
  std::mt19937 random;  // its numbers are the same everywhere
  std::vector<std::uint32_t> entries(kCount);
  for (auto& entry : entries) entry = 4 * (static_cast<std::uint32_t>(random()) % size);
  return best_rate(kCount * kPasses, threads, [&](std::int64_t, int) {
    for (int pass = 0; pass < kPasses; ++pass)
      benchmark::DoNotOptimize(loop(records.data(), entries.data(), kCount));
  });
}

Roof measured(int threads) {
  const RoofKernels& kernels = roof_kernels(chosen_isa());
  constexpr std::uint32_t kFirstCache = 1 << 9;    // records: 8 KiB
  constexpr std::uint32_t kSecondCache = 1 << 13;  // 128 KiB
  return {
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

}  // namespace bench
}  // namespace pbf
