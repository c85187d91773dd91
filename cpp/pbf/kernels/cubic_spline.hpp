#pragma once

#include <cmath>
#include <numbers>

namespace pbf {

/// Cubic spline [Mon92] with support h, one kernel for densities and gradients.
///   W(r)  = 8/(π h³) { 6(q³ − q²) + 1 for q ≤ ½;  2(1 − q)³ for q ≤ 1 }       [1/m³]
///   dW/dr = 48/(π h⁴) { q(3q − 2);  −(1 − q)² }                               [1/m⁴]
/// with q = ‖r‖/h, zero beyond.
template <class T>
struct CubicSpline {
  T h, inverse_h, W_scale, grad_scale;

  explicit CubicSpline(T support_radius)
      : h(support_radius),
        inverse_h(T(1) / h),
        W_scale(static_cast<T>(8.0 / (std::numbers::pi * std::pow(double(h), 3)))),
        grad_scale(static_cast<T>(48.0 / (std::numbers::pi * std::pow(double(h), 5)))) {}

  T W(T r2) const {
    const T q = std::sqrt(r2) * inverse_h;
    const T d = T(1) - q;
    if (d <= T(0)) return T(0);
    return W_scale * (q <= T(0.5) ? T(6) * q * q * (q - T(1)) + T(1) : T(2) * d * d * d);
  }
  /// s with ∇W = s · r                                                                    [1/m⁵]
  T grad_factor(T r2) const {
    const T q = std::sqrt(r2) * inverse_h;
    const T d = T(1) - q;
    if (d <= T(0)) return T(0);
    return grad_scale * (q <= T(0.5) ? T(3) * q - T(2) : -(d * d) / q);
  }
};

}  // namespace pbf
