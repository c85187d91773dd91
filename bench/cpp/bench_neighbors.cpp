#include "pbf/neighbors/cell_grid.hpp"
#include "pbf/neighbors/neighbor_list.hpp"

#include <benchmark/benchmark.h>

#include "dam_break.hpp"

namespace pbf::bench {
namespace {

constexpr Real kTimeStep = 1.0F / 240;
constexpr int kWarmUpSteps = 40;

Index brute_force_count(const Points& x, Index i, Real h) {
  return ((x.colwise() - x.col(i)).colwise().squaredNorm().array() < h * h).count() - 1;
}

/// Cell sort and neighbor lists of a fluid in motion, the two parts of the stage "neighbors".
void neighbors(benchmark::State& state) {
  const auto threads = static_cast<int>(state.range(1));
  Simulation simulation = dam_break(state.range(0), 0);
  for (int k = 0; k < kWarmUpSteps; ++k) simulation.step(kTimeStep);
  const Real h = simulation.fluid().h();
  const Points unsorted = simulation.positions();
  CellGrid grid;
  NeighborList list;
  Points x(3, unsorted.cols());
  for (auto _ : state) {
    grid.build(unsorted, h, threads);
    for (Index k = 0; k < x.cols(); ++k)
      x.col(k) = unsorted.col(grid.order()[static_cast<std::size_t>(k)]);
    list.build(grid, x, h, threads);
    benchmark::ClobberMemory();
  }

  state.SetItemsProcessed(state.iterations() * x.cols());
  for (Index i = 0; i < x.cols(); i += x.cols() / 16) {
    if (static_cast<Index>(list[i].size()) != brute_force_count(x, i, h)) {
      state.SkipWithError("wrong result: a neighbor is missing or one too many");
    }
  }
}
BENCHMARK(neighbors)
    ->ArgNames({"n", "threads"})
    ->ArgsProduct({{8'000, 64'000}, {1, 2, 0}})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace
}  // namespace pbf::bench
