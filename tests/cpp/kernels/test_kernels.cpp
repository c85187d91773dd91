#include "pbf/kernels/calibration.hpp"
#include "pbf/kernels/kernel.hpp"

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
                   CubicSpline<double>) {
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
                   CubicSpline<double>) {
  const Kernel kernel(0.1);
  for (const double r : {0.1, 0.1000001, 5.0}) {
    CHECK(kernel.W(r * r) == doctest::Approx(0.0));
    CHECK(kernel.slope(r * r) == doctest::Approx(0.0));
  }
}

TEST_CASE("cubic spline: the gradient is the derivative of W") {
  for (const int dimensions : {2, 3}) {
    const CubicSpline<double> kernel(0.1, 1, dimensions);
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
                   CubicSpline<float>) {
  CHECK(std::isfinite(Kernel(0.04F).slope(0.0F) * 0.0F));
}

TEST_CASE_TEMPLATE("kernels: a factor multiplies W and its gradient",
                   Kernel,
                   Poly6Spiky<double>,
                   CubicSpline<double>) {
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

}  // namespace pbf
