#pragma once

#include <cmath>
#include <numbers>

namespace pbf {

/// The pair of kernels of Position Based Fluids [MM13], after [MCG03].
///   W(r)  = 315/(64 π h³) (1 − q²)³          poly6, for densities              [1/m³]
///   ∇W(r) = −45/(π h⁴) (1 − q)² r/‖r‖        gradient of spiky, for gradients  [1/m⁴]
/// with q = ‖r‖/h ≤ 1, both zero beyond. The gradient has no direction at r = 0 and is the zero
/// vector there. ∇W is not the derivative of this W: spiky keeps close particles apart where
/// poly6's own gradient vanishes.
template <class T>
struct Poly6Spiky {
  T h, inverse_h, W_scale, grad_scale;

  explicit Poly6Spiky(T support_radius)
      : h(support_radius),
        inverse_h(T(1) / h),
        W_scale(static_cast<T>(315.0 / (64.0 * std::numbers::pi * std::pow(double(h), 3)))),
        grad_scale(static_cast<T>(-45.0 / (std::numbers::pi * std::pow(double(h), 4)))) {}

  /// W as a function of the squared distance: callers have it, and no square root is needed.
  T W(T r2) const {
    const T d = T(1) - r2 * (inverse_h * inverse_h);
    return d > T(0) ? W_scale * (d * d * d) : T(0);
  }
  /// s with ∇W = s · r                                                                    [1/m⁵]
  T grad_factor(T r2) const {
    const T r = std::sqrt(r2);
    const T d = T(1) - r * inverse_h;
    return d > T(0) && r > T(0) ? grad_scale * (d * d) / r : T(0);
  }
};

}  // namespace pbf
