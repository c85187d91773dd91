#include "stages.hpp"

namespace pbf::bench {
namespace {

/// Sort by cell and neighbor lists.
void neighbors(benchmark::State& state) { time_stage(state, Stage::neighbors); }
BENCHMARK(neighbors)->Apply(rows);

}  // namespace
}  // namespace pbf::bench
