#pragma once

#include "pbf/kernels/select.hpp"

#include <numbers>

namespace pbf {

/// Cubic spline [Mon92] with support h, one kernel for densities and gradients.
///   W(r)  = 8/(π h³) { 6(q³ − q²) + 1 for q ≤ ½;  2(1 − q)³ for q ≤ 1 }       [1/m³]
///   dW/dr = 48/(π h⁴) { q(3q − 2);  −(1 − q)² }                               [1/m⁴]
/// with q = ‖r‖/h, zero beyond. In a plane the constants are 40/(7π h²) [1/m²] and 240/(7π h³)
/// [1/m³], so that W integrates to one over it. Both may be given a factor, such as a volume.
template <class T>
struct CubicSpline {
  T h;
  T slope_unit;

  explicit CubicSpline(T support_radius, T factor = 1, int dimensions = 3) : h(support_radius) {
    using std::numbers::pi;
    const double radius = static_cast<double>(h);
    const double W0 =
        static_cast<double>(factor) *
        (dimensions == 2 ? 40 / (7 * pi * std::pow(radius, 2)) : 8 / (pi * std::pow(radius, 3)));
    per_h_ = static_cast<T>(1 / radius);
    W0_ = static_cast<T>(W0);
    slope_unit = static_cast<T>(6 * W0 / (radius * radius));
  }

  template <class A>
  [[gnu::always_inline]] A W(A r2) const {
    const A q = sqrt(r2) * A(per_h_);
    const A d = max(A(1) - q, A(0));
    return A(W0_) * select(q <= A(0.5F), A(6) * q * q * (q - A(1)) + A(1), A(2) * d * d * d);
  }
  /// The s ≥ 0 with ∇W = −s · r                                                          [1/m⁵]
  template <class A>
  [[gnu::always_inline]] A slope(A r2) const {
    return A(slope_unit) * slope_in_units(r2);
  }
  /// The same in units of slope_unit, which a sum over neighbors then needs once.
  template <class A>
  [[gnu::always_inline]] A slope_in_units(A r2) const {
    const A q = sqrt(r2) * A(per_h_);
    const A d = max(A(1) - q, A(0));
    return select(q <= A(0.5F), A(2) - A(3) * q, d * d / max(q, A(0.5F)));
  }

 private:
  T per_h_, W0_;
};

}  // namespace pbf
