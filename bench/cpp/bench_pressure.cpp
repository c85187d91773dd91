#include "stages.hpp"

namespace pbf::bench {
namespace {

/// The whole step by the pressure method, iterated to its tolerance.
void pressure(benchmark::State& state) { time_stage(state, {}, {}); }
BENCHMARK(pressure)->Apply(rows);

}  // namespace
}  // namespace pbf::bench
