#pragma once

namespace pbf {

/// While it lives, Mesa's software driver, if it is started, takes no more threads than the quota
/// of the container allows: it counts the processors that it may run on, and the quota does not
/// show there. What LP_NUM_THREADS says stands; without a quota below that count nothing changes.
class SoftwareThreads {
 public:
  SoftwareThreads();
  ~SoftwareThreads();
  SoftwareThreads(const SoftwareThreads&) = delete;
  SoftwareThreads& operator=(const SoftwareThreads&) = delete;

 private:
  bool set_ = false;
};

}  // namespace pbf
