#include "pbf/boundary/box.hpp"
#include "pbf/fluid/params.hpp"

#include "bind_params.hpp"

namespace pbf {

void register_params(py::module_& m) {
  bind_params<FluidParams>(m, "What the fluid is. SI units.")
      .def_property_readonly(
          "h", [](const FluidParams& self) { return shortest_double(self.h()); },
          "The support radius in force [m]: support_radius, or 2 * spacing.");
  bind_params<SolverParams>(
      m, "How the constraint is solved. The pure numbers mean the same at every resolution.");
  bind_params<Box>(m, "An axis-aligned tank: particles stay in the closed box.", 3);
}

}  // namespace pbf
