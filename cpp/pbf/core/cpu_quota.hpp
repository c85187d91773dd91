#pragma once

#include <filesystem>
#include <optional>

namespace pbf {

/// Cores' worth of time that a control group (a container) grants this process, rounded up; nothing
/// where there is no limit. Neither the number of processors nor the affinity mask knows of it, and
/// threads beyond it only make each other wait until the next period. Linux: cpu.max of version 2,
/// cfs_quota_us of version 1, of the group and those above it.
/// @param root  where /proc and /sys are
std::optional<int> cpu_quota(const std::filesystem::path& root = "/");

}  // namespace pbf
