#pragma once

#include "pbf/render/image.hpp"

namespace pbf {

/// Light from all directions as a picture: columns go once around, from behind over the left, ahead
/// and the right to behind again, rows from straight up to straight down. Ahead is -z and right +x
/// where y is up. Linear red, green and blue.
using EnvironmentMap = Pixels<float>;

/// Half floats, which textures hold, end there; the sun of a clear sky is brighter, but no screen
/// shows it.
inline constexpr float kBrightest = 60'000;

/// Throws InvalidParameter unless it has three channels of finite numbers >= 0, and a pixel.
void validate(const EnvironmentMap& map);

}  // namespace pbf
