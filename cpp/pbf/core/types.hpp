#pragma once

#include "pbf/core/real.hpp"

#include <Eigen/Core>

namespace pbf {

using Vec3 = Eigen::Matrix<Real, 3, 1>;
using Scalars = Eigen::Array<Real, Eigen::Dynamic, 1>;

/// Column i is particle i: `x.col(i)` reads as x_i. In memory this is `xyzxyz…`, which is a
/// C-contiguous NumPy array of shape (N, 3) and a GL buffer of vec3 at the same time.
using Points = Eigen::Matrix<Real, 3, Eigen::Dynamic>;
using PointsView = Eigen::Ref<const Points>;
using ScalarsView = Eigen::Ref<const Scalars>;

using Ids = Eigen::Array<std::int64_t, Eigen::Dynamic, 1>;

}  // namespace pbf
