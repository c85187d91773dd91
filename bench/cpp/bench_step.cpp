#include <benchmark/benchmark.h>

#include "dam_break.hpp"

namespace pbf::bench {
namespace {

constexpr Real kTimeStep = 1.0F / 240;
constexpr int kWarmUpSteps = 40;
constexpr int kTimedSteps = 60;

/// The whole step. Every row of the table walks through the same states: same start, same warm-up,
/// same number of steps, and the same bits for any number of threads.
void step(benchmark::State& state) {
  Simulation simulation = dam_break(state.range(0), static_cast<int>(state.range(1)));
  for (int k = 1; k < kWarmUpSteps; ++k) simulation.step(kTimeStep);
  StepReport total = simulation.step(kTimeStep);
  for (auto _ : state) total.add(simulation.step(kTimeStep));

  state.SetItemsProcessed(state.iterations() * simulation.size());
  state.counters["particles"] = static_cast<double>(simulation.size());
  state.counters["mean_density_error"] = total.mean_density_error;
  if (!(total.mean_density_error < 0.05))
    state.SkipWithError("wrong result: the fluid is compressed");
}
BENCHMARK(step)
    ->ArgNames({"n", "threads"})
    ->ArgsProduct({{8'000, 64'000}, {1, 2, 0}})
    ->Iterations(kTimedSteps)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace
}  // namespace pbf::bench
