#pragma once

#include "pbf/render/neighborhoods.hpp"

namespace pbf {

/// Sprites as ellipsoids that follow the fluid, flat at its surface and long in a jet [YT13]. With
///
///   w_ij = 1 - (|x_j - x_i| / s)^3 within s,   m_i = sum_j w_ij x_j / sum_j w_ij,
///   C_i = sum_j w_ij (x_j - m_i)(x_j - m_i)^T / sum_j w_ij = R diag(c_1 >= c_2 >= c_3) R^T,
///
/// j over the particles within s that are not deep (neighborhoods.hpp) and i itself, the sphere
/// around x_i becomes one around x' that is stretched by G:
///
///   x' = x_i + kCenterShare a_i (m_i - x_i),
///   G = R diag(c'_k / (c'_1 c'_2 c'_3)^(1/3))^(a_i) R^T,   c'_k = max(c_k, c_1 / kMostRatio),
///   a_i = anisotropy · min(1, sum_{j != i} w_ij / kFewest).
///
/// G keeps the volume. A particle alone stays the sphere that it is, and so does a deep one, or one
/// in the midst of others. Where the paper has a sphere of another size for particles with fewer
/// than 25 neighbors, a_i leads there without a step.
class Anisotropy {
 public:
  /// Of semi-axes, at most: k_r of the paper.
  static constexpr double kMostRatio = 4;
  /// Sum of weights of a group that is fully stretched: a sheet has 10, a row of particles 2.7, a
  /// body 27, at s = 2.4 particle distances.
  static constexpr double kFewest = 6;
  /// Lambda of the paper, which has 0.9: that takes a whole layer of particles off the surface, for
  /// normals that the depth filter makes nearly as good (docs/smoothing.md).
  static constexpr double kCenterShare = 0.3;

  /// @param particles   with crowding, which the centers keep; s is their distance
  /// @param count       of the first of them, which are wanted
  /// @param anisotropy  0 to 1
  void find(const Neighborhoods& particles, Index count, Real anisotropy, int threads = 0);

  [[nodiscard]] const Records& centers() const { return centers_; }
  /// Two records for each: G_xx, G_yy, G_zz and G_xy, G_xz, G_yz. The fourth numbers mean nothing.
  [[nodiscard]] const Records& stretches() const { return stretches_; }

 private:
  Records centers_, stretches_;
};

}  // namespace pbf
