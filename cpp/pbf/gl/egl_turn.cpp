#include "pbf/gl/egl_turn.hpp"

#include "pbf/core/error.hpp"

#include <atomic>
#include <string>
#include <unistd.h>

namespace pbf {
namespace {

constexpr const char* kAfterFork =
    "after fork() the graphics driver's threads are gone and it would wait for them for ever; "
    "start worker processes with the \"spawn\" method, or make no renderer before forking";

std::mutex& lock_of_all() {
  static std::mutex lock;
  return lock;
}

void forbid_after_fork() {
  static std::atomic<int> first{0};
  const int here = getpid();
  int process = 0;
  if (!first.compare_exchange_strong(process, here) && process != here) {
    throw RendererUnavailable("EGL was started in process " + std::to_string(process) +
                              ", this is its child " + std::to_string(here) + ": " + kAfterFork);
  }
}

}  // namespace

EglTurn::EglTurn() {
  forbid_after_fork();
  lock_ = std::unique_lock(lock_of_all());
}

void require_process(int process) {
  if (const int here = getpid(); here != process) {
    throw GlError("this renderer belongs to process " + std::to_string(process) +
                  ", this is process " + std::to_string(here) + ": " + kAfterFork);
  }
}

}  // namespace pbf
