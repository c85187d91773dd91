#pragma once

#include "pbf/core/types.hpp"

namespace pbf {

// Of what whoever asks for a picture says; InvalidParameter says what is wrong.

/// @param name  "width" or "height"   @return side
int checked_side(int side, const char* name);
void require_finite(const PointsView& positions);

}  // namespace pbf
