#include "pbf/render/anisotropy.hpp"

#include "pbf/core/parallel.hpp"
#include "pbf/render/anisotropy_kernels.hpp"
#include "pbf/render/candidates.hpp"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace pbf {
PBF_TABLE_BY_ISA(AnisotropyKernels, anisotropy_kernels, anisotropy_kernels)
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// R diag(c'_k / (c'_1 c'_2 c'_3)^(1/3))^a R^T of a covariance.
Matrix3d stretch(const Matrix3d& covariance, double a) {
  Eigen::SelfAdjointEigenSolver<Matrix3d> solver;
  solver.computeDirect(covariance);  // ascending
  const double largest = solver.eigenvalues()[2];
  if (!(largest > 0)) return Matrix3d::Identity();
  const Vector3d c = solver.eigenvalues().cwiseMax(largest / Anisotropy::kMostRatio);
  const Eigen::Array3d logs = c.array().log();
  const Vector3d axes = (a * (logs - logs.mean())).exp();
  const Matrix3d& R = solver.eigenvectors();
  return R * axes.asDiagonal() * R.transpose();
}

Real number(double a) { return static_cast<Real>(a); }

}  // namespace

void Anisotropy::find(const Neighborhoods& particles, Index count, Real anisotropy, int threads) {
  centers_.resize(count);
  stretches_.resize(2 * count);
  parallel_for(count, threads, [&](Index i) {
    centers_[i] = particles.particles()[i];
    stretches_[2 * i] = {1, 1, 1, 0};
    stretches_[2 * i + 1] = {0, 0, 0, 0};
  });
  const AnisotropyKernels& kernels = anisotropy_kernels(chosen_isa());
  const Real s = particles.distance();
  for_each_with_candidates(
      particles, threads, [](std::uint32_t) { return true; },
      [&](std::uint32_t k, const Candidates& candidates) {
        const Moments sum = kernels.moments(candidates, particles.sorted()[k], 1 / s);
        const double a = anisotropy * std::min(1.0, (sum.w - 1) / kFewest);
        if (!(a > 0)) return;
        const Vector3d m = Vector3d(sum.x, sum.y, sum.z) / sum.w;
        Matrix3d C;
        C << sum.xx, sum.xy, sum.xz, sum.xy, sum.yy, sum.yz, sum.xz, sum.yz, sum.zz;
        C = C / sum.w - m * m.transpose();
        const Vector3d shift = kCenterShare * a * s * m;
        const Index i = particles.place(k);
        Record& center = centers_[i];
        center.x += number(shift.x());
        center.y += number(shift.y());
        center.z += number(shift.z());
        const Matrix3d G = stretch(C, a);
        stretches_[2 * i] = {number(G(0, 0)), number(G(1, 1)), number(G(2, 2)), 0};
        stretches_[2 * i + 1] = {number(G(0, 1)), number(G(0, 2)), number(G(1, 2)), 0};
      });
}

}  // namespace pbf
