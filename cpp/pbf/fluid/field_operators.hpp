#pragma once

#include "pbf/fluid/discretization.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>

/// Differential operators on values carried by particles, one particle at a time. With V the
/// particle volume and ∇W_ij the kernel's gradient with respect to x_i:
///   ∇A_i  = V Σ_j (A_j − A_i) ∇W_ij                                   scalar → 3
///   J_i   = V Σ_j (a_j − a_i) ⊗ ∇W_ij ,  J[a][b] = ∂a_a/∂x_b          vector → 3×3
///   ∇·a   = tr J ,   ∇×a = (J_zy − J_yz, J_xz − J_zx, J_yx − J_xy)
///   ∇²A_i = 2 V Σ_j (A_i − A_j) (r_ij · ∇W_ij)/(‖r_ij‖² + 0.01 h²)    Brookshaw's form [Bro85]
/// The differences make constants exact; the corrected gradient makes linear fields exact as well,
/// at free surfaces too, by multiplying with the inverse of V Σ_j (x_j − x_i) ⊗ ∇W_ij.
namespace pbf {

using Mat3 = Eigen::Matrix<Real, 3, 3>;

/// What an operator reads: positions, who is near whom, the kernel and the particle volume.
template <class Kernel>
struct FieldSample {
  PointsView x;
  const NeighborList& near;
  const Kernel& kernel;
  Real V;

  /// Calls f(j, ∇W_ij, r_ij) for the neighbors j of i.
  template <class F>
  void for_each_gradient(Index i, F&& f) const {
    const Vec3 x_i = x.col(i);
    for (const std::uint32_t j : near[i]) {
      const Vec3 r = x_i - x.col(j);
      f(j, Vec3(-kernel.slope(r.squaredNorm()) * r), r);
    }
  }
};
// Clang before 17 does not deduce the argument of an aggregate by itself.
template <class Kernel>
FieldSample(PointsView, const NeighborList&, const Kernel&, Real) -> FieldSample<Kernel>;

template <class Kernel>
Vec3 gradient_at(const FieldSample<Kernel>& s, Index i, const ScalarsView& A) {
  Vec3 sum = Vec3::Zero();
  s.for_each_gradient(
      i, [&](Index j, const Vec3& grad_W, const Vec3&) { sum += (A[j] - A[i]) * grad_W; });
  return s.V * sum;
}

template <class Kernel>
Mat3 jacobian_at(const FieldSample<Kernel>& s, Index i, const PointsView& a) {
  Mat3 sum = Mat3::Zero();
  s.for_each_gradient(i, [&](Index j, const Vec3& grad_W, const Vec3&) {
    sum += (a.col(j) - a.col(i)) * grad_W.transpose();
  });
  return s.V * sum;
}

inline Vec3 curl_of(const Mat3& J) {
  return {J(2, 1) - J(1, 2), J(0, 2) - J(2, 0), J(1, 0) - J(0, 1)};
}

template <class Kernel>
Vec3 curl_at(const FieldSample<Kernel>& s, Index i, const PointsView& a) {
  return curl_of(jacobian_at(s, i, a));
}

template <class Kernel>
Real laplacian_at(const FieldSample<Kernel>& s, Index i, const ScalarsView& A) {
  const Real guard = Real(0.01) * s.kernel.h * s.kernel.h;
  Real sum = 0;
  s.for_each_gradient(i, [&](Index j, const Vec3& grad_W, const Vec3& r) {
    sum += (A[i] - A[j]) * r.dot(grad_W) / (r.squaredNorm() + guard);
  });
  return 2 * s.V * sum;
}

/// Turns a gradient or the rows of a Jacobian into the corrected one: ∇A ← M ∇A, J ← J Mᵀ.
/// M is the identity where the neighbors do not span space (fewer than four, or all in a plane).
template <class Kernel>
Mat3 gradient_correction_at(const FieldSample<Kernel>& s, Index i) {
  Mat3 sum = Mat3::Zero();
  s.for_each_gradient(
      i, [&](Index, const Vec3& grad_W, const Vec3& r) { sum -= r * grad_W.transpose(); });
  // V Σ (x_j − x_i) ⊗ ∇W is the identity for a full neighborhood; far from it there is nothing to
  // invert.
  const Mat3 moment = s.V * sum;
  return std::abs(moment.determinant()) > Real(1e-3) ? Mat3(moment.inverse())
                                                     : Mat3(Mat3::Identity());
}

}  // namespace pbf
