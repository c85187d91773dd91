#pragma once

#include <mutex>

namespace pbf {

/// A turn at asking EGL for devices and contexts, and at the tables filled on the way: one thread
/// at a time. In a child forked after the first turn there is none; it throws RendererUnavailable
/// before it waits for anything, since a thread that was not forked along may hold the lock.
class EglTurn {
 public:
  EglTurn();

 private:
  std::unique_lock<std::mutex> lock_;
};

/// Throws GlError unless this is the process with that id: what was made there is of no use in a
/// child. For callers with locks of their own, to be asked before they wait for one.
void require_process(int process);

}  // namespace pbf
