#include "pbf/core/error.hpp"
#include "pbf/core/parallel.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <stdexcept>
#include <sys/wait.h>
#include <unistd.h>

namespace pbf {

TEST_CASE("parallel_for: every index is visited once") {
  for (const Index n : {Index(0), Index(1), kChunk - 1, kChunk, 10 * kChunk + 3}) {
    CAPTURE(n);
    std::vector<int> visits(static_cast<std::size_t>(n), 0);
    parallel_for(n, 4, [&](Index i) { ++visits[static_cast<std::size_t>(i)]; });
    CHECK(std::count(visits.begin(), visits.end(), 1) == n);
  }
}

TEST_CASE("parallel_sum: the same bits for any number of threads") {
  const auto term = [](Index i) { return std::sin(static_cast<double>(i)) * 1e6; };
  const double one = parallel_sum(100'000, 1, term);
  for (const int threads : {2, 3, 4, 7, 16}) CHECK(parallel_sum(100'000, threads, term) == one);
}

TEST_CASE("parallel_for: an exception in a thread comes out of the call") {
  const auto fail_at_end = [](Index i) {
    if (i == 9'999) throw std::runtime_error("the last one");
  };
  CHECK_THROWS_WITH_AS(parallel_for(10'000, 4, fail_at_end), "the last one", std::runtime_error);
}

TEST_CASE("usable_threads: counts that would end the process are refused") {
  CHECK(usable_threads(3) == 3);
  CHECK(usable_threads(0) >= 1);
  CHECK_THROWS_AS(usable_threads(-1), InvalidParameter);
  CHECK_THROWS_AS(usable_threads(kMaxThreads + 1), InvalidParameter);
}

TEST_CASE("parallel_for: a forked child finishes its loops on one thread") {
  std::vector<double> values(10'000);
  const auto fill = [&] {
    parallel_for(10'000, 4, [&](Index i) { values[static_cast<std::size_t>(i)] = 1.0; });
  };
  fill();
  const pid_t child = fork();
  if (child == 0) {
    alarm(10);  // a hang ends the child by signal, which the check below tells from success
    fill();
    _exit(usable_threads(4) == 1 ? 0 : 1);
  }
  int status = -1;
  REQUIRE(waitpid(child, &status, 0) == child);
  CHECK(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 0);
}

}  // namespace pbf
