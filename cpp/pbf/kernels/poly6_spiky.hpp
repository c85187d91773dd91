#pragma once

#include "pbf/kernels/select.hpp"

#include <numbers>

namespace pbf {

/// The pair of kernels of Position Based Fluids [MM13], after [MCG03].
///   W(r)  = 315/(64 π h³) (1 − q²)³          poly6, for densities              [1/m³]
///   ∇W(r) = −45/(π h⁴) (1 − q)² r/‖r‖        gradient of spiky, for gradients  [1/m⁴]
/// In a plane the constants are 4/(π h²) and −30/(π h³), so that both integrate to one over it, and
/// the units 1/m² and 1/m³. Everywhere q = ‖r‖/h ≤ 1, both are zero beyond, and the gradient, which
/// has no direction at r = 0, is the zero vector there. ∇W is not the derivative of this W: spiky
/// keeps close particles apart where poly6's own gradient vanishes.
///
/// Both may be given a factor, such as a volume. In W it and the constant before the power stand
/// inside the power, where they cost nothing: 315/(64 π h³) (1 − q²)³ = (a − a q²)³.
template <class T>
struct Poly6Spiky {
  T h;
  T slope_unit;

  explicit Poly6Spiky(T support_radius, T factor = 1, int dimensions = 3) : h(support_radius) {
    using std::numbers::pi;
    const double radius = static_cast<double>(h);
    const double W0 =
        dimensions == 2 ? 4 / (pi * std::pow(radius, 2)) : 315 / (64 * pi * std::pow(radius, 3));
    const double grad0 =
        dimensions == 2 ? 30 / (pi * std::pow(radius, 3)) : 45 / (pi * std::pow(radius, 4));
    const double a = std::cbrt(static_cast<double>(factor) * W0);
    a_ = static_cast<T>(a);
    a_per_h2_ = static_cast<T>(a / (radius * radius));
    slope_unit = static_cast<T>(static_cast<double>(factor) * grad0 / (radius * radius));
    least_r2_ = static_cast<T>(1e-20 * radius * radius);
  }

  /// W as a function of the squared distance: callers have it, and no square root is needed.
  template <class A>
  [[gnu::always_inline]] A W(A r2) const {
    const A d = max(A(a_) - r2 * A(a_per_h2_), A(0));
    return d * d * d;
  }
  /// The s ≥ 0 with ∇W = −s · r                                                          [1/m⁵]
  template <class A>
  [[gnu::always_inline]] A slope(A r2) const {
    return A(slope_unit) * slope_in_units(r2);
  }
  /// The same in units of slope_unit, which a sum over neighbors then needs once.
  template <class A>
  [[gnu::always_inline]] A slope_in_units(A r2) const {
    // Finite where r = 0, so that s · r is zero there.
    const A r = sqrt(max(r2, A(least_r2_)));
    const A d = max(A(h) - r, A(0));
    return d * d / r;
  }

 private:
  T a_, a_per_h2_, least_r2_;
};

}  // namespace pbf
