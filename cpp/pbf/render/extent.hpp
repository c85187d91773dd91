#pragma once

#include "pbf/core/types.hpp"

namespace pbf {

/// What positions take up along three unit axes, but for those farther from the mean than six root
/// mean squares: one particle that flew off must not take a grid with it.
struct Extent {
  Eigen::Array3d mean = Eigen::Array3d::Zero();
  Eigen::Array3d limit = Eigen::Array3d::Zero();            ///< what is farther does not count [m]
  Eigen::Array3d lower = Eigen::Array3d::Constant(kNone);   ///< [m]
  Eigen::Array3d upper = Eigen::Array3d::Constant(-kNone);  ///< without positions less than lower

  /// Where these coordinates are within the limit of the mean, they belong to it.
  void include(const Eigen::Array3d& at);

  static constexpr double kNone = 1e300;
};

/// @param axes  the rows
Extent extent(const PointsView& positions, const Eigen::Matrix<Real, 3, 3>& axes, int threads);

}  // namespace pbf
