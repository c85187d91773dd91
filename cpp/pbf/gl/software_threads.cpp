#include "pbf/gl/software_threads.hpp"

#include "pbf/core/cpu_quota.hpp"

#include <cstdlib>
#include <string>
#include <thread>

namespace pbf {

SoftwareThreads::SoftwareThreads() {
  const auto processors = static_cast<int>(std::thread::hardware_concurrency());
  const int quota = cpu_quota().value_or(processors);
  if (quota >= processors || std::getenv("LP_NUM_THREADS") != nullptr) return;
  set_ = setenv("LP_NUM_THREADS", std::to_string(quota).c_str(), 0) == 0;
}

SoftwareThreads::~SoftwareThreads() {
  if (set_) unsetenv("LP_NUM_THREADS");
}

}  // namespace pbf
