#pragma once

#include "pbf/fluid/simulation.hpp"

#include <benchmark/benchmark.h>

#include <optional>
#include <vector>

/// Every benchmark walks through the same dam break: a cube of about n particles falls over in a
/// tank three times as long. The clock starts when it is in motion, and runs for one stage or for
/// the whole step. It measures the solver as a user runs it, not a stage fed by hand.
namespace pbf::bench {

/// One, two and all threads.
std::vector<std::int64_t> thread_counts();

/// Times `stage`, or the whole step without one. The result is wrong, and has no time, if the fluid
/// is compressed or if the state differs in a bit from that of another row with as many particles:
/// the benchmarks of one executable differ in threads alone.
void time_stage(benchmark::State& state,
                std::optional<Stage> stage,
                SolverParams solver = {.iterations = 4});

/// True once a benchmark had a wrong result.
bool any_wrong_result();

/// The rows of a benchmark: particles × threads, and the number of steps.
void rows(benchmark::internal::Benchmark* benchmark);

/// The dam break in motion, of about n particles a spacing of 2 cm apart [m].
const Points& dam_break_positions(Index n);

}  // namespace pbf::bench
