#include "pbf/kernels/calibration.hpp"
#include "pbf/kernels/kernel.hpp"

#include <Eigen/Core>
#include <doctest/doctest.h>

namespace pbf {
namespace {

/// ∫ W over the ball, in 2-D the disk, in shells.
template <class Kernel>
double integral(const Kernel& kernel, double h, int dimensions) {
  constexpr int kShells = 20'000;
  double sum = 0;
  for (int k = 0; k < kShells; ++k) {
    const double r = (k + 0.5) * h / kShells;
    const double shell = 2 * std::numbers::pi * r * (dimensions == 2 ? 1 : 2 * r);
    sum += shell * kernel.W(r * r) * h / kShells;
  }
  return sum;
}

}  // namespace

TEST_CASE_TEMPLATE("kernels: W integrates to one",
                   Kernel,
                   Poly6Spiky<double>,
                   CubicSpline<double>,
                   Wendland<double>) {
  for (const int dimensions : {2, 3}) {
    for (const double h : {1e-4, 0.05, 1.0, 1e3}) {
      CAPTURE(dimensions);
      CAPTURE(h);
      CHECK(integral(Kernel(h, 1, dimensions), h, dimensions) ==
            doctest::Approx(1.0).epsilon(1e-6));
    }
  }
}

TEST_CASE_TEMPLATE("kernels: W and its gradient are zero at the support radius and beyond",
                   Kernel,
                   Poly6Spiky<double>,
                   CubicSpline<double>,
                   Wendland<double>) {
  const Kernel kernel(0.1);
  for (const double r : {0.1, 0.1000001, 5.0}) {
    CHECK(kernel.W(r * r) == doctest::Approx(0.0));
    CHECK(kernel.slope(r * r) == doctest::Approx(0.0));
  }
}

TEST_CASE_TEMPLATE("cubic spline, Wendland: the gradient is the derivative of W",
                   Kernel,
                   CubicSpline<double>,
                   Wendland<double>) {
  for (const int dimensions : {2, 3}) {
    const Kernel kernel(0.1, 1, dimensions);
    for (const double r : {0.01, 0.03, 0.049, 0.051, 0.08, 0.099}) {
      const double e = 1e-7;
      const double slope = (kernel.W((r + e) * (r + e)) - kernel.W((r - e) * (r - e))) / (2 * e);
      CHECK(-kernel.slope(r * r) * r == doctest::Approx(slope).epsilon(1e-5));
    }
  }
}

TEST_CASE("spiky: the gradient is the derivative of 15/(π h⁶) (h − r)³, in 2-D 10/(π h⁵)") {
  const double h = 0.1;
  for (const int dimensions : {2, 3}) {
    const Poly6Spiky<double> kernel(h, 1, dimensions);
    const double constant = (dimensions == 2 ? 10 * h : 15) / (std::numbers::pi * std::pow(h, 6));
    const auto spiky = [&](double r) { return constant * std::pow(h - r, 3); };
    for (const double r : {0.01, 0.05, 0.09}) {
      const double e = 1e-7;
      CHECK(-kernel.slope(r * r) * r ==
            doctest::Approx((spiky(r + e) - spiky(r - e)) / (2 * e)).epsilon(1e-5));
    }
  }
}

TEST_CASE_TEMPLATE("kernels: the gradient is finite where two particles coincide",
                   Kernel,
                   Poly6Spiky<float>,
                   CubicSpline<float>,
                   Wendland<float>) {
  CHECK(std::isfinite(Kernel(0.04F).slope(0.0F) * 0.0F));
}

TEST_CASE_TEMPLATE("kernels: a factor multiplies W and its gradient",
                   Kernel,
                   Poly6Spiky<double>,
                   CubicSpline<double>,
                   Wendland<double>) {
  const Kernel plain(0.1), scaled(0.1, 1e-6);
  for (const double r : {0.0, 0.02, 0.07, 0.2}) {
    CHECK(scaled.W(r * r) == doctest::Approx(1e-6 * plain.W(r * r)));
    CHECK(scaled.slope(r * r) == doctest::Approx(1e-6 * plain.slope(r * r)));
  }
}

TEST_CASE("calibration: the lattice sum of W times V is one, at any scale") {
  for (const double spacing : {1e-4, 0.02, 100.0}) {
    const Calibration c = calibrate(KernelChoice::poly6_spiky, 3, spacing, 2 * spacing);
    CHECK(c.volume / std::pow(spacing, 3) == doctest::Approx(0.99032).epsilon(1e-5));
    CHECK(c.ideal_denominator * spacing * spacing == doctest::Approx(0.36620).epsilon(1e-4));
  }
  CHECK_THROWS_AS(calibrate(KernelChoice::poly6_spiky, 3, 0.1, 0.05), InvalidParameter);
}

TEST_CASE("calibration: the largest eigenvalue is that of a periodic lattice's matrix") {
  // 8 particles a side: wave vectors of π/4, which the calibration's grid holds. Power iteration on
  // λ → C(Δp(λ)) / D, by the formulas of density_constraint.hpp.
  constexpr int n = 8;
  for (const KernelChoice choice :
       {KernelChoice::poly6_spiky, KernelChoice::cubic_spline, KernelChoice::wendland}) {
    const Calibration c = calibrate(choice, 3, 1.0, 2.0);
    const double largest = largest_eigenvalue(choice, 3, 1.0, 2.0);
    std::vector<Eigen::Vector3i> offsets;
    std::vector<Eigen::Vector3d> grads;  // V ∇W_ij for j = i + offset
    with_kernel<double>(choice, 3, 2.0, [&](const auto& kernel) {
      for (int k = 0; k < 125; ++k) {
        const Eigen::Vector3i o(k % 5 - 2, k / 5 % 5 - 2, k / 25 - 2);
        const double s = kernel.slope(o.cast<double>().squaredNorm());
        if (o.isZero() || !(s > 0)) continue;
        offsets.push_back(o);
        grads.emplace_back(c.volume * s * o.cast<double>());
      }
    });
    const auto at = [](const Eigen::Vector3i& p) {
      const auto wrapped = [](int a) { return (a + n) % n; };
      return wrapped(p.x()) + n * (wrapped(p.y()) + n * wrapped(p.z()));
    };
    const auto site = [](int i) { return Eigen::Vector3i(i % n, i / n % n, i / (n * n)); };
    Eigen::VectorXd lambda(n * n * n);
    for (int i = 0; i < lambda.size(); ++i) lambda[i] = std::sin(7.0 * i * i + i);
    double eigenvalue = 0;
    for (int step = 0; step < 300; ++step) {
      Eigen::Matrix3Xd dp = Eigen::Matrix3Xd::Zero(3, lambda.size());
      Eigen::VectorXd change = Eigen::VectorXd::Zero(lambda.size());
      for (int i = 0; i < lambda.size(); ++i) {
        for (std::size_t k = 0; k < offsets.size(); ++k) {
          dp.col(i) += (lambda[i] + lambda[at(site(i) + offsets[k])]) * grads[k];
        }
      }
      for (int i = 0; i < lambda.size(); ++i) {
        for (std::size_t k = 0; k < offsets.size(); ++k) {
          change[i] += grads[k].dot(dp.col(i) - dp.col(at(site(i) + offsets[k])));
        }
      }
      change /= c.ideal_denominator;
      eigenvalue = change.norm() / lambda.norm();
      lambda = change.normalized();
    }
    CHECK(eigenvalue <= largest * (1 + 1e-9));
    CHECK(eigenvalue > 0.93 * largest);  // their wave vectors are four times as dense
  }
}

}  // namespace pbf
