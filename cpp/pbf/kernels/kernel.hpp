#pragma once

#include "pbf/core/fields.hpp"
#include "pbf/kernels/cubic_spline.hpp"
#include "pbf/kernels/poly6_spiky.hpp"
#include "pbf/kernels/wendland.hpp"

#include <array>

namespace pbf {

/// Which functions stand for W and ∇W.
enum class KernelChoice { poly6_spiky, cubic_spline, wendland };

template <>
struct Choices<KernelChoice> {
  static constexpr std::array names{"poly6_spiky", "cubic_spline", "wendland"};
};

/// Calls f with the chosen kernel of support radius h, in space (3 dimensions) or in a plane (2),
/// times a factor, so that loops are compiled for each kernel.
template <class T = Real, class F>
decltype(auto) with_kernel(KernelChoice choice, int dimensions, T h, T factor, F&& f) {
  if (choice == KernelChoice::cubic_spline) return f(CubicSpline<T>(h, factor, dimensions));
  if (choice == KernelChoice::wendland) return f(Wendland<T>(h, factor, dimensions));
  return f(Poly6Spiky<T>(h, factor, dimensions));
}
template <class T = Real, class F>
decltype(auto) with_kernel(KernelChoice choice, int dimensions, T h, F&& f) {
  return with_kernel(choice, dimensions, h, T(1), std::forward<F>(f));
}

}  // namespace pbf
