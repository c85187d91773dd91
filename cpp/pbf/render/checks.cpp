#include "pbf/render/checks.hpp"

#include "pbf/core/error.hpp"

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
  for (Index i = 0; i < positions.cols(); ++i) {
    if (!positions.col(i).allFinite()) {
      throw InvalidParameter("positions: particle " + std::to_string(i) +
                             " is not finite; every coordinate must be");
    }
  }
}

}  // namespace pbf
