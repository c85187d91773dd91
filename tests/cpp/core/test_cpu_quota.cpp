#include "pbf/core/cpu_quota.hpp"

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <unistd.h>

using namespace pbf;
namespace fs = std::filesystem;

namespace {

/// A root directory with the files of /proc and /sys that a test wants.
class Root {
 public:
  Root() : path_(fs::temp_directory_path() / ("pbf_quota_" + std::to_string(getpid()))) {}
  ~Root() { fs::remove_all(path_); }
  Root(const Root&) = delete;
  Root& operator=(const Root&) = delete;
  Root& file(const std::string& name, const std::string& text) {
    fs::create_directories((path_ / name).parent_path());
    std::ofstream(path_ / name) << text;
    return *this;
  }
  [[nodiscard]] const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

}  // namespace

TEST_CASE("cpu_quota: nothing without control groups or without a limit") {
  CHECK_FALSE(cpu_quota("/nowhere").has_value());
  Root root;
  root.file("proc/self/cgroup", "0::/\n").file("sys/fs/cgroup/cpu.max", "max 100000\n");
  CHECK_FALSE(cpu_quota(root.path()).has_value());
}

TEST_CASE("cpu_quota: version 2, rounded up to whole cores") {
  Root root;
  root.file("proc/self/cgroup", "0::/\n");
  for (const auto& [text, cores] : {std::pair{"200000 100000", 2}, std::pair{"150000 100000", 2},
                                    std::pair{"10000 100000", 1}, std::pair{"75000 25000", 3}}) {
    CAPTURE(text);
    root.file("sys/fs/cgroup/cpu.max", text);
    CHECK(cpu_quota(root.path()) == cores);
  }
}

TEST_CASE("cpu_quota: the tightest of the group and those above it") {
  Root root;
  root.file("proc/self/cgroup", "0::/job/task\n")
      .file("sys/fs/cgroup/job/cpu.max", "300000 100000")
      .file("sys/fs/cgroup/job/task/cpu.max", "max 100000");
  CHECK(cpu_quota(root.path()) == 3);
  root.file("sys/fs/cgroup/job/task/cpu.max", "100000 100000");
  CHECK(cpu_quota(root.path()) == 1);
}

TEST_CASE("cpu_quota: version 1, also where the group has the name that the host gives it") {
  Root root;
  root.file("proc/self/cgroup", "5:memory:/x\n4:cpu,cpuacct:/docker/4711\n0::/\n")
      .file("sys/fs/cgroup/cpu/cpu.cfs_period_us", "100000\n")
      .file("sys/fs/cgroup/cpu/cpu.cfs_quota_us", "-1\n");
  CHECK_FALSE(cpu_quota(root.path()).has_value());
  root.file("sys/fs/cgroup/cpu/cpu.cfs_quota_us", "250000\n");
  CHECK(cpu_quota(root.path()) == 3);
}

TEST_CASE("cpu_quota: what makes no sense is no limit") {
  Root root;
  root.file("proc/self/cgroup", "nonsense\n0::/\n").file("sys/fs/cgroup/cpu.max", "0 0\n");
  CHECK_FALSE(cpu_quota(root.path()).has_value());
  root.file("sys/fs/cgroup/cpu.max", "many\n");
  CHECK_FALSE(cpu_quota(root.path()).has_value());
}
