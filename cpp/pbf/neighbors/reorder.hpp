#pragma once

#include "pbf/core/records.hpp"
#include "pbf/core/types.hpp"

#include <algorithm>

/// Bringing arrays with a value per particle into another order, such as that of a grid, and back;
/// and into records, and back.
namespace pbf {

inline Vec3 vec3(const Record& record) { return {record.x, record.y, record.z}; }

/// The points, with w = 0.
inline Records records_of(const PointsView& points) {
  Records records(points.cols());
  for (Index i = 0; i < points.cols(); ++i)
    records[i] = {points(0, i), points(1, i), points(2, i), 0};
  return records;
}
inline Points points_of(const Records& records) {
  Points points(3, records.size());
  for (Index i = 0; i < records.size(); ++i) points.col(i) = vec3(records[i]);
  return points;
}
/// The fourth numbers.
inline Scalars scalars_of(const Records& records) {
  Scalars scalars(records.size());
  for (Index i = 0; i < records.size(); ++i) scalars[i] = records[i].w;
  return scalars;
}

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
