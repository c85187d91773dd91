#pragma once

#include "pbf/core/real.hpp"

#include <string>
#include <utility>
#include <vector>

namespace pbf {

/// What drawing the last picture took.
struct RenderReport {
  Index particles = 0;
  /// Each pass in order and its time [ms]. Empty unless timing was asked for.
  std::vector<std::pair<std::string, double>> milliseconds;
};

}  // namespace pbf
