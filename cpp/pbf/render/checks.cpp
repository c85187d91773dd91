#include "pbf/render/checks.hpp"

#include "pbf/core/error.hpp"
#include "pbf/core/parallel.hpp"

#include <string>

namespace pbf {

int checked_side(int side, const char* name) {
  if (side < 1) {
    throw InvalidParameter(std::string(name) + " = " + std::to_string(side) +
                           " pixels: must be at least 1");
  }
  return side;
}

void require_finite(const PointsView& positions) {
  const auto is_finite = [&](Index i) { return positions.col(i).allFinite(); };
  const auto is_bad = [&](Index i) { return is_finite(i) ? Index{0} : Index{1}; };
  if (parallel_sum<Index>(positions.cols(), 0, is_bad) == 0) return;
  Index first = 0;
  while (is_finite(first)) ++first;
  throw InvalidParameter("positions: particle " + std::to_string(first) +
                         " is not finite; every coordinate must be");
}

}  // namespace pbf
