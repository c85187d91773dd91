#include "pbf/kernels/calibration.hpp"

#include <cmath>

namespace pbf {

Calibration calibrate(KernelChoice choice, int dimensions, double spacing, double h) {
  if (!(spacing > 0) || !(h > spacing) || !std::isfinite(h)) {
    throw InvalidParameter("support_radius = " + to_text(h) +
                           " m: must be greater than the spacing (" + to_text(spacing) +
                           " m), and the spacing greater than 0");
  }
  return with_kernel<double>(choice, dimensions, h, [&](const auto& kernel) {
    const int reach = static_cast<int>(std::ceil(h / spacing));
    const int reach_z = dimensions == 2 ? 0 : reach;
    double sum_W = 0;
    double sum_grad2 = 0;  // Σ ‖∇W‖²; the lattice is symmetric, so ∇_i C = V Σ ∇W = 0 adds nothing
    for (int a = -reach; a <= reach; ++a) {
      for (int b = -reach; b <= reach; ++b) {
        for (int c = -reach_z; c <= reach_z; ++c) {
          const double r2 = spacing * spacing * (a * a + b * b + c * c);
          const double s = r2 > 0 ? kernel.slope(r2) : 0;
          sum_W += kernel.W(r2);
          sum_grad2 += s * s * r2;
        }
      }
    }
    const double volume = 1 / sum_W;
    return Calibration{.volume = volume, .ideal_denominator = volume * volume * sum_grad2};
  });
}

}  // namespace pbf
