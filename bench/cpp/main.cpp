#include "pbf/core/isa.hpp"

#include <benchmark/benchmark.h>

#include "roof.hpp"
#include "stages.hpp"
#include <cstdlib>
#include <fstream>
#include <iomanip>
#include <sstream>
#include <string>

namespace pbf::bench {
namespace {

std::string processor() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  }
  return "unknown";
}

void add_roofs(int threads) {
  const Roof& roof = roof_of(threads);
  const auto add = [&](const char* name, double per_second) {
    std::ostringstream giga;
    giga << std::fixed << std::setprecision(2) << per_second / 1e9;
    benchmark::AddCustomContext("threads:" + std::to_string(threads) + "/" + name, giga.str());
  };
  add("fused_gflop_per_s", roof.fused_flops);
  add("separate_gflop_per_s", roof.separate_flops);
  add("bandwidth_gb_per_s", roof.bandwidth);
  add("record_loads_g_per_s", roof.record_loads);
  add("record_loads_l2_g_per_s", roof.record_loads_l2);
  add("record_gathers_g_per_s", roof.record_gathers);
}

/// What a number is of, in the head of every output.
void add_context() {
  benchmark::AddCustomContext("processor", processor());
  benchmark::AddCustomContext("compiler", PBF_BENCH_COMPILER);
  benchmark::AddCustomContext("commit", PBF_BENCH_COMMIT);
  const char* wait_policy = std::getenv("OMP_WAIT_POLICY");
  benchmark::AddCustomContext("omp_wait_policy", wait_policy ? wait_policy : "not set");
  benchmark::AddCustomContext("isa", isa_name(chosen_isa()));
  for (const std::int64_t threads : thread_counts()) add_roofs(static_cast<int>(threads));
}

}  // namespace
}  // namespace pbf::bench

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  pbf::bench::add_context();
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return pbf::bench::any_wrong_result() ? 1 : 0;
}
