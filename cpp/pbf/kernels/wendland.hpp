#pragma once

#include "pbf/kernels/select.hpp"

#include <numbers>

namespace pbf {

/// Wendland's C2 function [Wen95] with support h, one kernel for densities and gradients.
///   W(r)  = 21/(2 π h³) (1 − q)⁴ (1 + 4 q)       [1/m³]
///   dW/dr = −210/(π h⁴) q (1 − q)³               [1/m⁴]
/// with q = ‖r‖/h, zero beyond. In a plane the constants are 7/(π h²) [1/m²] and 140/(π h³) [1/m³],
/// so that W integrates to one over it. Its Fourier transform is positive, so that particles do not
/// pair up [DA12]. Both may be given a factor, such as a volume.
template <class T>
struct Wendland {
  T h;
  T slope_unit;

  explicit Wendland(T support_radius, T factor = 1, int dimensions = 3) : h(support_radius) {
    using std::numbers::pi;
    const double radius = static_cast<double>(h);
    const double W0 =
        static_cast<double>(factor) *
        (dimensions == 2 ? 7 / (pi * std::pow(radius, 2)) : 21 / (2 * pi * std::pow(radius, 3)));
    per_h_ = static_cast<T>(1 / radius);
    W0_ = static_cast<T>(W0);
    slope_unit = static_cast<T>(20 * W0 / (radius * radius));
  }

  template <class A>
  [[gnu::always_inline]] A W(A r2) const {
    const A q = sqrt(r2) * A(per_h_);
    const A d = max(A(1) - q, A(0));
    const A d2 = d * d;
    return A(W0_) * (d2 * d2) * (A(1) + A(4) * q);
  }
  /// The s ≥ 0 with ∇W = −s · r                                                          [1/m⁵]
  template <class A>
  [[gnu::always_inline]] A slope(A r2) const {
    return A(slope_unit) * slope_in_units(r2);
  }
  /// The same in units of slope_unit, which a sum over neighbors then needs once.
  template <class A>
  [[gnu::always_inline]] A slope_in_units(A r2) const {
    const A d = max(A(1) - sqrt(r2) * A(per_h_), A(0));
    return d * d * d;
  }

 private:
  T per_h_, W0_;
};

}  // namespace pbf
