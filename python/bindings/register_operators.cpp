#include "pbf/fluid/particle_fields.hpp"

#include "bind_params.hpp"
#include "numpy_io.hpp"

namespace pbf {
namespace {

KernelChoice kernel_named(const std::string& name) {
  try {
    return PythonForm<KernelChoice>::in(name);
  } catch (const InvalidParameter& e) {
    throw InvalidParameter(std::string("kernel = ") + e.what());
  }
}

ParticleFields make_fields(const py::object& positions,
                           Real support_radius,
                           Real volume,
                           const std::string& kernel,
                           bool corrected,
                           int num_threads) {
  const FloatArray x = points_array(positions, "positions");
  const ParticleFields::Options options{.kernel = kernel_named(kernel),
                                        .volume = volume,
                                        .corrected = corrected,
                                        .num_threads = num_threads};
  const WithoutGil no_python_in_here;
  return {points_view(x), support_radius, options};
}

/// Runs a member of ParticleFields without the GIL.
template <class F>
auto without_gil(F&& f) {
  const WithoutGil no_python_in_here;
  return f();
}

}  // namespace

void register_operators(py::module_& m) {
  using Fields = ParticleFields;
  py::class_<Fields>(m, "ParticleFields",
                     "A cloud of particles on which fields are differentiated.")
      .def(py::init(&make_fields), "positions"_a, "support_radius"_a, "volume"_a, "kernel"_a,
           "corrected"_a, "num_threads"_a)
      .def("relative_density",
           [](const Fields& self) {
             return scalars_to_numpy(without_gil([&] { return self.relative_density(); }));
           })
      .def("gradient",
           [](const Fields& self, const py::object& values) {
             const FloatArray A = scalars_array(values, "values");
             return points_to_numpy(without_gil([&] { return self.gradient(scalars_view(A)); }));
           })
      .def("jacobian",
           [](const Fields& self, const py::object& values) {
             const FloatArray a = points_array(values, "values");
             auto J = without_gil([&] { return self.jacobian(points_view(a)); });
             const py::ssize_t n = J.cols();
             return to_numpy(std::move(J), {n, 3, 3});
           })
      .def("divergence",
           [](const Fields& self, const py::object& values) {
             const FloatArray a = points_array(values, "values");
             return scalars_to_numpy(without_gil([&] { return self.divergence(points_view(a)); }));
           })
      .def("curl",
           [](const Fields& self, const py::object& values) {
             const FloatArray a = points_array(values, "values");
             return points_to_numpy(without_gil([&] { return self.curl(points_view(a)); }));
           })
      .def("laplacian", [](const Fields& self, const py::object& values) {
        const FloatArray A = scalars_array(values, "values");
        return scalars_to_numpy(without_gil([&] { return self.laplacian(scalars_view(A)); }));
      });
}

}  // namespace pbf
