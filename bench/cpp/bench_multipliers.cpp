#include "stages.hpp"

namespace pbf::bench {
namespace {

/// λ, first half of an iteration.
void multipliers(benchmark::State& state) { time_stage(state, Stage::multipliers); }
BENCHMARK(multipliers)->Apply(rows);

}  // namespace
}  // namespace pbf::bench
