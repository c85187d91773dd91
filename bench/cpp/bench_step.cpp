#include "stages.hpp"

namespace pbf::bench {
namespace {

/// The whole step, with the milliseconds of each stage.
void step(benchmark::State& state) { time_stage(state, {}); }
BENCHMARK(step)->Apply(rows);

}  // namespace
}  // namespace pbf::bench
