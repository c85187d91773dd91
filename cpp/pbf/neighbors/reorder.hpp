#pragma once

#include "pbf/core/types.hpp"

#include <algorithm>

/// Bringing arrays with a value per particle into another order, such as that of a grid, and back.
namespace pbf {

/// Numbers per particle in an array: 3 for points, 1 for scalars and ids.
template <class Array>
constexpr Index kPerParticle = Array::RowsAtCompileTime == 3 ? 3 : 1;

/// to[k] = from[i]
template <class Array>
void copy_particle(const Array& from, Index i, Array& to, Index k) {
  const auto* source = from.data() + kPerParticle<Array> * i;
  std::copy(source, source + kPerParticle<Array>, to.data() + kPerParticle<Array> * k);
}

/// result[k] = values[order[k]]
template <class Array, class Order>
Array gathered(const Array& values, const Order& order) {
  Array result(values);
  Index k = 0;
  for (const auto i : order) copy_particle(values, static_cast<Index>(i), result, k++);
  return result;
}

/// result[order[k]] = values[k]: undoes gathered.
template <class Array, class Order>
Array scattered(const Array& values, const Order& order) {
  Array result(values);
  Index k = 0;
  for (const auto i : order) copy_particle(values, k++, result, static_cast<Index>(i));
  return result;
}

}  // namespace pbf
