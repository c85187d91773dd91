#pragma once

#include "pbf/core/types.hpp"

namespace pbf {

/// Particles on the cubic lattice of the given spacing that fill the box [lower, upper]: the first
/// half a spacing inside lower, as many as fit. A side that is a multiple of the spacing holds that
/// many layers exactly; the rest of another side stays empty at its upper end. Throws
/// InvalidParameter unless spacing > 0 and upper >= lower, all finite, and if the count would pass
/// 2^31. In 2 dimensions: one layer of the square lattice in x and y, at the z midway.
Points block(const Vec3& lower, const Vec3& upper, Real spacing, int dimensions = 3);

/// The lattice points within `radius` of `center`; the center lies in the middle of a lattice cell,
/// in 2 dimensions in the plane of the layer.
Points ball(const Vec3& center, Real radius, Real spacing, int dimensions = 3);

}  // namespace pbf
