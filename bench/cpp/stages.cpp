#include "stages.hpp"

#include "pbf/core/stopwatch.hpp"
#include "pbf/core/threads.hpp"
#include "pbf/neighbors/reorder.hpp"
#include "pbf/scene/shapes.hpp"

#include "model.hpp"
#include <algorithm>
#include <cmath>
#include <iomanip>
#include <map>
#include <sstream>
#include <thread>
#include <utility>

namespace pbf::bench {
namespace {

constexpr Real kTimeStep = 1.0F / 240;
constexpr int kStepsToMotion = 40;
constexpr int kTimedSteps = 5;
constexpr double kMostDensityError = 0.05;

bool wrong_result = false;

Simulation tank(Index n, const SolverParams& solver) {
  const FluidParams fluid;
  const Real side = fluid.spacing * static_cast<Real>(std::lround(std::cbrt(n)));
  return Simulation(fluid, solver, Box{.lower{0, 0, 0}, .upper{3 * side, 2 * side, side}});
}

struct Motion {
  Points x, v;
  double pairs = 0;       ///< of neighbors, from both sides
  double list_bytes = 0;  ///< least size of their lists
};

double count_pairs(const Points& x, Real h) {
  CellGrid grid;
  grid.build(records_of(x), h, 0);
  NeighborList list;
  list.build(grid, records_of(gathered(x, grid.order())), h, 0);
  double pairs = 0;
  for (Index i = 0; i < list.size(); ++i) pairs += static_cast<double>(list[i].size());
  return pairs;
}

/// Found once for each n, since a million particles take their time.
const Motion& dam_break_in_motion(Index n) {
  static std::map<Index, Motion> motions;
  const auto found = motions.find(n);
  if (found != motions.end()) return found->second;
  Simulation simulation = tank(n, {.iterations = 4});
  const Box& domain = *simulation.domain();
  const Real side = domain.upper.z();
  simulation.add_particles(block({0, 0, 0}, {side, side, side}, simulation.fluid().spacing));
  for (int k = 0; k < kStepsToMotion; ++k) simulation.step(kTimeStep);
  Motion motion{simulation.positions(), simulation.velocities()};
  motion.pairs = count_pairs(motion.x, simulation.fluid().h());
  motion.list_bytes = motion.pairs * sizeof(std::uint32_t);
  return motions.emplace(n, std::move(motion)).first->second;
}

}  // namespace

const Points& dam_break_positions(Index n) { return dam_break_in_motion(n).x; }

namespace {

/// Compares with the first run of as many particles.
bool has_the_same_bits(const Simulation& simulation) {
  static std::map<Index, std::uint64_t> hashes;
  const std::uint64_t hash = simulation.state_hash();
  return hashes.try_emplace(simulation.size(), hash).first->second == hash;
}

void fail(benchmark::State& state, const std::string& why) {
  wrong_result = true;
  state.SkipWithError(("wrong result: " + why).c_str());
}

double passes(Stage stage, const StepReport& total) {
  const bool iterated = stage == Stage::multipliers || stage == Stage::corrections;
  return iterated ? total.iterations : total.steps;
}

}  // namespace

std::vector<std::int64_t> thread_counts() {
  const auto all = std::min<std::int64_t>(std::thread::hardware_concurrency(), kMaxThreads);
  return all > 2 ? std::vector<std::int64_t>{1, 2, all} : std::vector<std::int64_t>{1, 2};
}

void time_stage(benchmark::State& state, std::optional<Stage> stage, SolverParams solver) {
  const Motion& motion = dam_break_in_motion(state.range(0));
  const auto threads = static_cast<int>(state.range(1));
  solver.num_threads = threads;
  Simulation simulation = tank(state.range(0), solver);
  simulation.add_particles(motion.x, motion.v);
  simulation.step(kTimeStep);  // allocates

  StepReport total{.steps = 0};
  double seconds = 0;
  for (auto _ : state) {
    double step_ms = 0;
    StepReport report;
    {
      const Stopwatch stopwatch(step_ms);
      report = simulation.step(kTimeStep);
    }
    const double ms = stage ? report.milliseconds[static_cast<std::size_t>(*stage)] : step_ms;
    state.SetIterationTime(1e-3 * ms);
    seconds += 1e-3 * ms;
    total.add(report);
  }

  const auto particles = static_cast<double>(simulation.size());
  double least_seconds = 0;
  std::ostringstream label;
  for (std::size_t k = 0; k < kStageNames.size(); ++k) {
    const auto part = static_cast<Stage>(k);
    const bool was_off = total.milliseconds[k] == 0;
    if (was_off || part != stage.value_or(part)) continue;
    const Floor floor =
        floor_of(part, particles, motion.pairs, motion.list_bytes, roof_of(threads));
    least_seconds += passes(part, total) * floor.seconds();
    if (stage) {
      label << floor.roof() << ", ";
    } else {
      state.counters[std::string("ms_") + kStageNames[k]] = total.milliseconds[k] / total.steps;
    }
  }
  label << "state " << std::hex << std::setfill('0') << std::setw(16) << simulation.state_hash();
  state.SetLabel(label.str());
  state.counters["particles"] = particles;
  state.counters["pairs_per_particle"] = motion.pairs / particles;
  state.counters["bytes_per_particle"] = static_cast<double>(simulation.bytes()) / particles;
  state.counters["ns_per_particle"] =
      1e9 * seconds / (particles * (stage ? passes(*stage, total) : total.steps));
  state.counters["roof_share"] = least_seconds / seconds;
  state.counters["mean_density_error"] = total.mean_density_error;
  if (!(total.mean_density_error < kMostDensityError)) fail(state, "the fluid is compressed");
  if (!has_the_same_bits(simulation)) fail(state, "not the bits of another number of threads");
}

bool any_wrong_result() { return wrong_result; }

void rows(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgNames({"n", "threads"})
      ->ArgsProduct({{10'000, 100'000, 1'000'000}, thread_counts()})
      ->Iterations(kTimedSteps)
      ->UseManualTime()
      ->Unit(benchmark::kMillisecond);
}

}  // namespace pbf::bench
