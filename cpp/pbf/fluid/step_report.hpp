#pragma once

#include "pbf/core/stopwatch.hpp"

#include <algorithm>
#include <array>

namespace pbf {

enum class Stage {
  predict,
  neighbors,
  boundary,
  multipliers,
  corrections,
  velocity,
  vorticity,
  xsph,
  density,
  count
};
inline constexpr std::array<const char*, static_cast<std::size_t>(Stage::count)> kStageNames{
    "predict",  "neighbors", "boundary", "multipliers", "corrections",
    "velocity", "vorticity", "xsph",     "density"};

/// What a time step did. Density errors are compression, max(C, 0), at the positions the step ended
/// with: at a free surface the density is lower by nature and counts as no error.
struct StepReport {
  int steps = 1;
  int iterations = 0;
  double mean_density_error = 0;  ///< mean over particles of max(ρ/ρ0 − 1, 0)
  double max_density_error = 0;   ///< largest over particles
  bool stable = true;             ///< false where fluid has twice its density in the mean
  std::array<double, static_cast<std::size_t>(Stage::count)> milliseconds{};

  /// Starts the clock of a stage; it stops with the end of the scope.
  [[nodiscard]] Stopwatch time(Stage stage) {
    return Stopwatch(milliseconds[static_cast<std::size_t>(stage)]);
  }

  [[nodiscard]] double total_milliseconds() const {
    double total = 0;
    for (const double ms : milliseconds) total += ms;
    return total;
  }
  /// Takes in the report of the step that followed: counts and times add up, the mean error is the
  /// mean over steps, the largest error the largest.
  void add(const StepReport& next) {
    const double weight = static_cast<double>(next.steps) / (steps + next.steps);
    mean_density_error += weight * (next.mean_density_error - mean_density_error);
    max_density_error = std::max(max_density_error, next.max_density_error);
    stable = stable && next.stable;
    steps += next.steps;
    iterations += next.iterations;
    for (std::size_t k = 0; k < milliseconds.size(); ++k) milliseconds[k] += next.milliseconds[k];
  }
};

}  // namespace pbf
