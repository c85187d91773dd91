#include "pbf/core/threads.hpp"

#include "pbf/core/cpu_quota.hpp"
#include "pbf/core/error.hpp"

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <omp.h>
#include <pthread.h>
#include <string>

namespace pbf {
namespace {

std::atomic<bool> threads_were_used{false};
std::atomic<bool> forked_after_use{false};

void note_fork() {
  if (threads_were_used.load()) forked_after_use.store(true);
}

/// OpenMP counts the processors that it may run on; the quota of a container is below that.
int default_threads() {
  static const int limit = [] {
    const bool user_said = std::getenv("OMP_NUM_THREADS") != nullptr;
    return user_said ? kMaxThreads : std::min(cpu_quota().value_or(kMaxThreads), kMaxThreads);
  }();
  return std::min(omp_get_max_threads(), limit);
}

}  // namespace

int usable_threads(int requested) {
  if (requested < 0 || requested > kMaxThreads) {
    throw InvalidParameter("num_threads = " + std::to_string(requested) +
                           ": must be between 0 (all) and " + std::to_string(kMaxThreads));
  }
  static const int registered = pthread_atfork(nullptr, nullptr, note_fork);
  static_cast<void>(registered);
  if (forked_after_use.load(std::memory_order_relaxed)) return 1;
  const int threads = requested > 0 ? requested : default_threads();
  if (threads > 1) threads_were_used.store(true, std::memory_order_relaxed);
  return threads;
}

}  // namespace pbf
