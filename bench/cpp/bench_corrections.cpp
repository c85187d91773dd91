#include "stages.hpp"

namespace pbf::bench {
namespace {

/// Δp, second half of an iteration.
void corrections(benchmark::State& state) { time_stage(state, Stage::corrections); }
BENCHMARK(corrections)->Apply(rows);

}  // namespace
}  // namespace pbf::bench
