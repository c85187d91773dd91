#include "pbf/scene/shapes.hpp"

#include "pbf/core/fields.hpp"

#include <cmath>

namespace pbf {
namespace {

constexpr double kMostParticles = 2147483648.0;

void require_spacing(Real spacing) {
  if (!(spacing > 0) || !std::isfinite(spacing)) {
    throw InvalidParameter("spacing = " + to_text(spacing) + " m: must be finite, > 0");
  }
}

void require_dimensions(int dimensions) {
  if (dimensions != 2 && dimensions != 3) {
    throw InvalidParameter("dimensions = " + to_text(dimensions) + ": must be 2 or 3");
  }
}

}  // namespace

Points block(const Vec3& lower, const Vec3& upper, Real spacing, int dimensions) {
  require_spacing(spacing);
  require_dimensions(dimensions);
  if (!lower.allFinite() || !upper.allFinite() || !(upper.array() >= lower.array()).all()) {
    throw InvalidParameter("block: upper = " + to_text(upper) +
                           " m must be finite and not less than lower = " + to_text(lower) +
                           " m on any axis");
  }
  // A side of 0.6 m holds 30 layers of 0.02 m, though 0.6F / 0.02F is a little less than 30.
  const Eigen::Array3d sides =
      (upper.cast<double>() - lower.cast<double>()).array() / static_cast<double>(spacing);
  Eigen::Array3d counts = (sides + 1e-3).floor();
  Eigen::Array3d corner = lower.cast<double>().array();
  if (dimensions == 2) {
    counts[2] = 1;
    const double middle = (corner[2] + static_cast<double>(upper[2])) / 2;
    corner[2] = middle - 0.5 * static_cast<double>(spacing);
  }
  if (counts.prod() > kMostParticles) {
    throw InvalidParameter("block: " + to_text(counts.prod()) +
                           " particles are more than 2^31; use a larger spacing");
  }
  const Eigen::Array<Index, 3, 1> n = counts.cast<Index>();
  Points x(3, n.prod());
  Index i = 0;
  for (Index c = 0; c < n[2]; ++c) {
    for (Index b = 0; b < n[1]; ++b) {
      for (Index a = 0; a < n[0]; ++a) {
        const Eigen::Array3d cell{static_cast<double>(a), static_cast<double>(b),
                                  static_cast<double>(c)};
        x.col(i++) = (corner + (cell + 0.5) * static_cast<double>(spacing)).cast<Real>();
      }
    }
  }
  return x;
}

Points ball(const Vec3& center, Real radius, Real spacing, int dimensions) {
  require_spacing(spacing);
  require_dimensions(dimensions);
  if (!center.allFinite() || !(radius >= 0) || !std::isfinite(radius)) {
    throw InvalidParameter("ball: center = " + to_text(center) +
                           " m and radius = " + to_text(radius) + " m must be finite, radius >= 0");
  }
  const Real half = std::ceil(radius / spacing) * spacing;
  const Vec3 corner{half, half, dimensions == 2 ? 0 : half};
  const Points cube = block(center - corner, center + corner, spacing, dimensions);
  Points x(3, cube.cols());
  Index kept = 0;
  for (Index i = 0; i < cube.cols(); ++i) {
    if ((cube.col(i) - center).squaredNorm() <= radius * radius) x.col(kept++) = cube.col(i);
  }
  return x.leftCols(kept);
}

}  // namespace pbf
