#include "pbf/core/cpu_quota.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <string>

namespace pbf {
namespace {

using std::filesystem::path;

/// Time granted in a period over the period; zero or less where a file is missing or says "max".
double granted(const path& group, bool version_2) {
  double quota = 0;
  double period = 0;
  if (version_2) {
    std::ifstream(group / "cpu.max") >> quota >> period;
  } else {
    std::ifstream(group / "cpu.cfs_quota_us") >> quota;
    std::ifstream(group / "cpu.cfs_period_us") >> period;
  }
  return period > 0 ? quota / period : 0;
}

/// A line of /proc/self/cgroup is "number:controllers:/group"; version 2 names no controllers.
struct Membership {
  std::string controllers, group;
};
Membership membership(const std::string& line) {
  const auto first = line.find(':');
  const auto second = line.find(':', first + 1);
  if (first == std::string::npos || second == std::string::npos) return {"none", ""};
  return {line.substr(first + 1, second - first - 1), line.substr(second + 1)};
}

bool lists_cpu(const std::string& controllers) {
  std::istringstream names(controllers);
  for (std::string name; std::getline(names, name, ',');) {
    if (name == "cpu") return true;
  }
  return false;
}

}  // namespace

std::optional<int> cpu_quota(const path& root) {
  double least = HUGE_VAL;
  std::ifstream lines(root / "proc/self/cgroup");
  for (std::string line; std::getline(lines, line);) {
    const auto [controllers, group] = membership(line);
    const bool version_2 = controllers.empty();
    if (!version_2 && !lists_cpu(controllers)) continue;
    const path mount = root / (version_2 ? "sys/fs/cgroup" : "sys/fs/cgroup/cpu");
    // Inside a container the group may be named as the host sees it; then only the mount is there.
    for (path below = path(group).relative_path();; below = below.parent_path()) {
      if (const double cores = granted(mount / below, version_2); cores > 0) {
        least = std::min(least, cores);
      }
      if (below.empty()) break;
    }
  }
  if (!std::isfinite(least)) return std::nullopt;
  return static_cast<int>(std::max(1.0, std::ceil(std::min(least, 1e6))));
}

}  // namespace pbf
