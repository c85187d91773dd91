#include "stages.hpp"

namespace pbf::bench {
namespace {

/// ρ, once at the end of a step; a sweep of its own only where there is no XSPH to take it along.
void density(benchmark::State& state) {
  time_stage(state, Stage::density, {.iterations = 4, .xsph = 0});
}
BENCHMARK(density)->Apply(rows);

}  // namespace
}  // namespace pbf::bench
