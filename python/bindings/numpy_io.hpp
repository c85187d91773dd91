#pragma once

#include "pbf/core/error.hpp"
#include "pbf/core/finite.hpp"
#include "pbf/core/types.hpp"

#include <pybind11/numpy.h>

#include "common.hpp"
#include <memory>
#include <string>
#include <vector>

/// The one door for arrays. In: whatever NumPy can read as real numbers, as a C-contiguous float32
/// array of the right shape with finite values, or a typed error that names the argument. Out: a
/// fresh array that owns its data.
namespace pbf {

using FloatArray = py::array_t<float, py::array::c_style | py::array::forcecast>;

inline std::string shape_text(const py::array& array) {
  std::string text = "(";
  for (py::ssize_t k = 0; k < array.ndim(); ++k) {
    text += (k > 0 ? ", " : "") + std::to_string(array.shape(k));
  }
  return text + (array.ndim() == 1 ? ",)" : ")");
}

/// Throws unless every number is finite; says which row is the first that is not.
inline void require_finite(const FloatArray& array, const char* name) {
  const float* data = array.data();
  if (all_finite({data, static_cast<std::size_t>(array.size())})) return;
  const py::ssize_t row_length =
      array.ndim() > 1 ? array.size() / std::max<py::ssize_t>(array.shape(0), 1) : 1;
  py::ssize_t bad = 0;
  py::ssize_t first = 0;
  for (py::ssize_t k = array.size(); k-- > 0;) {
    if (!std::isfinite(data[k])) {
      ++bad;
      first = k / row_length;
    }
  }
  throw InvalidParameter(std::string(name) + ": " + std::to_string(bad) + " of " +
                         std::to_string(array.size()) +
                         " numbers are not finite (or too large for float32), the first in row " +
                         std::to_string(first) + "; must be finite");
}

/// Throws if it is an array of NumPy's that says of some of its numbers that they are none: what
/// stands in their place would be taken for data.
inline void require_unmasked(py::handle object, const char* name) {
  if (!py::hasattr(object, "mask")) return;
  const py::object masked = py::module_::import("numpy").attr("ma");
  if (!py::isinstance(object, masked.attr("MaskedArray"))) return;
  const auto count = masked.attr("count_masked")(object).cast<py::ssize_t>();
  if (count == 0) return;
  throw InvalidParameter(std::string(name) + ": " + std::to_string(count) +
                         " of its numbers are masked; give an array of those that count (see "
                         "numpy.ma.compress_rows)");
}

/// Real numbers of any layout and precision as contiguous float32. No copy if they are that
/// already.
inline FloatArray float_array(py::handle object, const char* name) {
  require_unmasked(object, name);
  py::array array;
  try {
    array = py::array::ensure(object);
  } catch (const py::error_already_set&) {
    array = py::array();
  }
  const char kind = array ? array.dtype().kind() : 'O';
  if (kind != 'f' && kind != 'i' && kind != 'u') {
    PyErr_Clear();
    const std::string got =
        array ? "dtype " + py::str(array.dtype()).cast<std::string>()
              : "a " + py::str(py::type::of(object).attr("__name__")).cast<std::string>();
    raise("WrongType",
          std::string(name) + ": expected an array of real numbers (float32), got " + got);
  }
  // A float64 beyond float32's range becomes infinite here and is reported by require_finite, not
  // by a warning.
  const py::module_ numpy = py::module_::import("numpy");
  py::object quiet = numpy.attr("errstate")("over"_a = "ignore", "invalid"_a = "ignore");
  quiet.attr("__enter__")();
  FloatArray result(array);
  quiet.attr("__exit__")(py::none(), py::none(), py::none());
  require_finite(result, name);
  return result;
}

/// Shape (n, 3), one row per particle.
inline FloatArray points_array(py::handle object, const char* name) {
  FloatArray array = float_array(object, name);
  if (array.ndim() != 2 || array.shape(1) != 3) {
    throw InvalidParameter(std::string(name) +
                           ": expected shape (n, 3), one row per particle, got " +
                           shape_text(array));
  }
  return array;
}

/// Shape (n,).
inline FloatArray scalars_array(py::handle object, const char* name) {
  FloatArray array = float_array(object, name);
  if (array.ndim() != 1) {
    throw InvalidParameter(std::string(name) + ": expected shape (n,), got " + shape_text(array));
  }
  return array;
}

/// Views into the array's memory: valid while the array lives.
inline Eigen::Map<const Points> points_view(const FloatArray& array) {
  return {array.data(), 3, static_cast<Index>(array.shape(0))};
}
inline Eigen::Map<const Scalars> scalars_view(const FloatArray& array) {
  return {array.data(), static_cast<Index>(array.shape(0))};
}

inline void require_rows(const FloatArray& array,
                         const char* name,
                         py::ssize_t rows,
                         const char* like) {
  if (array.shape(0) != rows) {
    throw InvalidParameter(std::string(name) + ": " + std::to_string(array.shape(0)) +
                           " rows, but " + like + " has " + std::to_string(rows) +
                           "; must be equal");
  }
}

/// Hands an Eigen matrix over to NumPy without a copy; the array owns it.
template <class Matrix>
py::array_t<typename Matrix::Scalar> to_numpy(Matrix&& matrix, std::vector<py::ssize_t> shape) {
  using Plain = std::remove_cvref_t<Matrix>;
  auto owned = std::make_unique<Plain>(std::forward<Matrix>(matrix));
  auto* data = owned->data();
  py::capsule owner(owned.release(), [](void* pointer) { delete static_cast<Plain*>(pointer); });
  return py::array_t<typename Plain::Scalar>(std::move(shape), data, owner);
}
inline py::array_t<float> points_to_numpy(Points&& points) {
  const py::ssize_t n = points.cols();
  return to_numpy(std::move(points), {n, 3});
}
inline py::array_t<float> scalars_to_numpy(Scalars&& scalars) {
  const py::ssize_t n = scalars.size();
  return to_numpy(std::move(scalars), {n});
}

}  // namespace pbf
