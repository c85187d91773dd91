#pragma once

#include <cmath>
#include <type_traits>

/// Kernels are written once for plain numbers and for vectors of them (core/lanes.hpp), which have
/// functions of these names as well.
namespace pbf {

template <class T>
requires std::is_floating_point_v<T> T select(bool condition, T yes, T no) {
  return condition ? yes : no;
}
template <class T>
requires std::is_floating_point_v<T> T max(T a, T b) { return a > b ? a : b; }
using std::sqrt;

}  // namespace pbf
