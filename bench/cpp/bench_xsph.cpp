#include "stages.hpp"

namespace pbf::bench {
namespace {

/// XSPH viscosity.
void xsph(benchmark::State& state) { time_stage(state, Stage::xsph); }
BENCHMARK(xsph)->Apply(rows);

}  // namespace
}  // namespace pbf::bench
