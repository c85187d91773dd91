#include "pbf/kernels/calibration.hpp"

#include <Eigen/Core>

#include <cmath>
#include <numbers>
#include <vector>

namespace pbf {
namespace {

/// f(cell, r2, s) for every point of the lattice that can be within h, its squared distance and the
/// s of ∇W = −s · r there.
template <class Kernel, class F>
void for_each_site(const Kernel& kernel, int dimensions, double spacing, F&& f) {
  const int reach = static_cast<int>(std::ceil(kernel.h / spacing));
  const int reach_z = dimensions == 2 ? 0 : reach;
  for (int a = -reach; a <= reach; ++a) {
    for (int b = -reach; b <= reach; ++b) {
      for (int c = -reach_z; c <= reach_z; ++c) {
        const double r2 = spacing * spacing * (a * a + b * b + c * c);
        f(Eigen::Vector3i(a, b, c), r2, r2 > 0 ? kernel.slope(r2) : 0);
      }
    }
  }
}

/// A lattice point and −∇W there.
struct Site {
  Eigen::Vector3i cell;
  Eigen::Vector3d grad;
};

/// max over k of |Σ ∇W(r) sin(k·r)|². By symmetry k1 ≥ k2 ≥ k3 ≥ 0 is enough, up to π per spacing.
double largest_symbol(const std::vector<Site>& sites) {
  constexpr int kSteps = 16;
  // sin(k·r) depends on k·r modulo 2π only.
  std::array<double, 2 * kSteps> sine;
  for (int k = 0; k < 2 * kSteps; ++k) {
    sine[static_cast<std::size_t>(k)] = std::sin(std::numbers::pi * k / kSteps);
  }
  double largest = 0;
  for (int k1 = 0; k1 <= kSteps; ++k1) {
    for (int k2 = 0; k2 <= k1; ++k2) {
      for (int k3 = 0; k3 <= k2; ++k3) {
        Eigen::Vector3d sum = Eigen::Vector3d::Zero();
        for (const Site& site : sites) {
          const int phase = k1 * site.cell[0] + k2 * site.cell[1] + k3 * site.cell[2];
          sum += sine[static_cast<unsigned>(phase) % (2 * kSteps)] * site.grad;
        }
        largest = std::max(largest, sum.squaredNorm());
      }
    }
  }
  return largest;
}

}  // namespace

Calibration calibrate(KernelChoice choice, int dimensions, double spacing, double h) {
  if (!(spacing > 0) || !(h > spacing) || !std::isfinite(h)) {
    throw InvalidParameter("support_radius = " + to_text(h) +
                           " m: must be greater than the spacing (" + to_text(spacing) +
                           " m), and the spacing greater than 0");
  }
  return with_kernel<double>(choice, dimensions, h, [&](const auto& kernel) {
    double sum_W = 0;
    double sum_grad2 = 0;  // Σ ‖∇W‖²; the lattice is symmetric, so ∇_i C = V Σ ∇W = 0 adds nothing
    for_each_site(kernel, dimensions, spacing, [&](const auto&, double r2, double s) {
      sum_W += kernel.W(r2);
      sum_grad2 += s * s * r2;
    });
    const double volume = 1 / sum_W;
    return Calibration{.volume = volume, .ideal_denominator = volume * volume * sum_grad2};
  });
}

double largest_eigenvalue(KernelChoice choice, int dimensions, double spacing, double h) {
  return with_kernel<double>(choice, dimensions, h, [&](const auto& kernel) {
    std::vector<Site> sites;
    double sum_grad2 = 0;
    for_each_site(kernel, dimensions, spacing,
                  [&](const Eigen::Vector3i& cell, double r2, double s) {
                    sum_grad2 += s * s * r2;
                    if (s > 0) sites.push_back({cell, s * spacing * cell.cast<double>()});
                  });
    return largest_symbol(sites) / sum_grad2;
  });
}

}  // namespace pbf
