#pragma once

#include "pbf/core/threads.hpp"
#include "pbf/core/types.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <vector>

namespace pbf {

/// Calls f(first, last) for consecutive ranges that cover [0, n), several at once. f must write
/// only what belongs to its range: then the schedule cannot show in the result. An exception thrown
/// by f is rethrown here, after all threads have come home.
template <class F>
void parallel_chunks(Index n, int threads, Index chunk, F&& f) {
  const Index chunks = (n + chunk - 1) / chunk;
  const int workers = static_cast<int>(std::min<Index>(usable_threads(threads), chunks));
  if (workers <= 1) {
    for (Index c = 0; c < chunks; ++c) f(c * chunk, std::min(n, (c + 1) * chunk));
    return;
  }
  std::exception_ptr first_error;
  std::atomic<bool> failed{false};
#pragma omp parallel for num_threads(workers) schedule(dynamic, 1)
  for (Index c = 0; c < chunks; ++c) {
    if (failed.load(std::memory_order_relaxed)) continue;
    try {
      f(c * chunk, std::min(n, (c + 1) * chunk));
    } catch (...) {
      if (!failed.exchange(true)) first_error = std::current_exception();
    }
  }
  if (first_error) std::rethrow_exception(first_error);
}

/// Calls f(i) for i in [0, n), several at once; f(i) must write only what belongs to i.
template <class F>
void parallel_for(Index n, int threads, F&& f) {
  parallel_chunks(n, threads, kChunk, [&](Index first, Index last) {
    for (Index i = first; i < last; ++i) f(i);
  });
}

/// f(0) + f(1) + …, added in chunks of fixed size and the chunks in order: the same bits for any
/// number of threads. Sum starts as Sum{} and is added to with +=, whatever adding means to it.
template <class Sum = double, class F>
Sum parallel_sum(Index n, int threads, F&& f) {
  std::vector<Sum> partial(static_cast<std::size_t>((n + kChunk - 1) / kChunk));
  parallel_chunks(n, threads, kChunk, [&](Index first, Index last) {
    Sum sum{};
    for (Index i = first; i < last; ++i) sum += f(i);
    partial[static_cast<std::size_t>(first / kChunk)] = sum;
  });
  Sum total{};
  for (const Sum& p : partial) total += p;
  return total;
}

/// The largest of 0, f(0), f(1), …
template <class F>
Real parallel_max(Index n, int threads, F&& f) {
  struct Largest {
    Real value = 0;
    Largest& operator+=(const Largest& other) {
      value = std::max(value, other.value);
      return *this;
    }
  };
  return parallel_sum<Largest>(n, threads, [&](Index i) { return Largest{f(i)}; }).value;
}

}  // namespace pbf
