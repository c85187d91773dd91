#include "stages.hpp"

namespace pbf::bench {
namespace {

/// Vorticity confinement, which is off by default.
void vorticity(benchmark::State& state) {
  time_stage(state, Stage::vorticity, {.iterations = 4, .vorticity = 0.01F});
}
BENCHMARK(vorticity)->Apply(rows);

}  // namespace
}  // namespace pbf::bench
