#pragma once

#include "pbf/core/real.hpp"

#include <span>

namespace pbf {

/// Whether none of them is infinite or no number at all.
bool all_finite(std::span<const Real> numbers, int threads = 0);

}  // namespace pbf
