#include "pbf/fluid/simulation.hpp"
#include "pbf/scene/shapes.hpp"

#include "bind_params.hpp"
#include "numpy_io.hpp"
#include <mutex>

namespace pbf {
namespace {

/// A simulation that several Python threads may hold: their calls take turns. The GIL is let go
/// first, so that a thread waiting for its turn does not hold up the one at work.
struct SharedSimulation {
  using Guard = std::lock_guard<std::mutex>;
  Simulation simulation;
  std::mutex mutex;

  SharedSimulation(const FluidParams& fluid,
                   const SolverParams& solver,
                   const std::optional<Box>& domain)
      : simulation(fluid, solver, domain) {}

  template <class F>
  auto with(F&& f) {
    const WithoutGil no_python_in_here;
    const Guard guard(mutex);
    return f(simulation);
  }
};

void let_ctrl_c_through() {
  const py::gil_scoped_acquire python;
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

void bind_step_report(py::module_& m) {
  py::class_<StepReport>(m, "StepReport", "What a time step, or several, did.")
      .def_readonly("steps", &StepReport::steps, "Time steps reported on.")
      .def_readonly("iterations", &StepReport::iterations, "Solver iterations, all steps together.")
      .def_readonly("mean_density_error", &StepReport::mean_density_error,
                    "Mean over particles of max(density / rest_density - 1, 0): compression only.")
      .def_readonly("max_density_error", &StepReport::max_density_error, "The largest compression.")
      .def_readonly("stable", &StepReport::stable,
                    "False if the fluid was crushed to twice its density in the mean: the time "
                    "step is too long.")
      .def_property_readonly(
          "milliseconds",
          [](const StepReport& self) {
            std::map<std::string, double> result;
            for (std::size_t k = 0; k < kStageNames.size(); ++k)
              result[kStageNames[k]] = self.milliseconds[k];
            return result;
          },
          "Milliseconds by stage.")
      .def_property_readonly("total_milliseconds", &StepReport::total_milliseconds,
                             "All stages together.")
      .def("add", &StepReport::add, "next"_a, "Take in the report of the step that followed.")
      .def("__repr__", [](const StepReport& self) {
        return "StepReport(steps=" + std::to_string(self.steps) +
               ", iterations=" + std::to_string(self.iterations) +
               ", mean_density_error=" + to_text(self.mean_density_error) +
               ", max_density_error=" + to_text(self.max_density_error) +
               ", total_milliseconds=" + to_text(self.total_milliseconds()) + ")";
      });
}

void bind_simulation(py::module_& m) {
  py::class_<SharedSimulation>(m, "Simulation", "Position Based Fluids. Use pbfluids.Simulation.")
      .def(py::init<const FluidParams&, const SolverParams&, const std::optional<Box>&>(),
           "fluid"_a, "solver"_a, "domain"_a)
      .def(
          "add_particles",
          [](SharedSimulation& self, const py::object& positions, const py::object& velocities) {
            const FloatArray x = points_array(positions, "positions");
            std::optional<Points> v;
            if (!velocities.is_none()) v = points_view(points_array(velocities, "velocities"));
            Ids ids = self.with([&](Simulation& s) { return s.add_particles(points_view(x), v); });
            const py::ssize_t n = ids.size();
            return to_numpy(std::move(ids), {n});
          },
          "positions"_a, "velocities"_a = py::none())
      .def(
          "step",
          [](SharedSimulation& self, Real dt) {
            return self.with([&](Simulation& s) { return s.step(dt); });
          },
          "dt"_a)
      .def(
          "advance",
          [](SharedSimulation& self, Real seconds) {
            return self.with([&](Simulation& s) { return s.advance(seconds, let_ctrl_c_through); });
          },
          "seconds"_a)
      .def("positions",
           [](SharedSimulation& self) {
             return points_to_numpy(self.with([](Simulation& s) { return s.positions(); }));
           })
      .def("velocities",
           [](SharedSimulation& self) {
             return points_to_numpy(self.with([](Simulation& s) { return s.velocities(); }));
           })
      .def("densities",
           [](SharedSimulation& self) {
             return scalars_to_numpy(self.with([](Simulation& s) { return s.densities(); }));
           })
      .def("multipliers",
           [](SharedSimulation& self) {
             return scalars_to_numpy(self.with([](Simulation& s) { return s.multipliers(); }));
           })
      .def("pressures",
           [](SharedSimulation& self) {
             return scalars_to_numpy(self.with([](Simulation& s) { return s.pressures(); }));
           })
      .def("ids",
           [](SharedSimulation& self) {
             Ids ids = self.with([](Simulation& s) { return s.ids(); });
             const py::ssize_t n = ids.size();
             return to_numpy(std::move(ids), {n});
           })
      .def("time",
           [](SharedSimulation& self) { return self.with([](Simulation& s) { return s.time(); }); })
      .def("step_count",
           [](SharedSimulation& self) {
             return self.with([](Simulation& s) { return s.step_count(); });
           })
      .def("size",
           [](SharedSimulation& self) { return self.with([](Simulation& s) { return s.size(); }); })
      .def("state_hash",
           [](SharedSimulation& self) {
             return self.with([](Simulation& s) { return s.state_hash(); });
           })
      .def(
          "fluid",
          [](SharedSimulation& self) { return self.with([](Simulation& s) { return s.fluid(); }); })
      .def("solver",
           [](SharedSimulation& self) {
             return self.with([](Simulation& s) { return s.solver(); });
           })
      .def("domain",
           [](SharedSimulation& self) {
             return self.with([](Simulation& s) { return s.domain(); });
           })
      .def(
          "set_solver",
          [](SharedSimulation& self, const SolverParams& solver) {
            self.with([&](Simulation& s) { s.set_solver(solver); });
          },
          "solver"_a);
}

Vec3 vec3(const std::array<double, 3>& v) { return Eigen::Vector3d(v[0], v[1], v[2]).cast<Real>(); }

}  // namespace

void register_fluid(py::module_& m) {
  bind_step_report(m);
  bind_simulation(m);
  m.def(
      "block",
      [](const std::array<double, 3>& lower, const std::array<double, 3>& upper, Real spacing,
         int dimensions) {
        return points_to_numpy(block(vec3(lower), vec3(upper), spacing, dimensions));
      },
      "lower"_a, "upper"_a, "spacing"_a, "dimensions"_a = 3);
  m.def(
      "ball",
      [](const std::array<double, 3>& center, Real radius, Real spacing, int dimensions) {
        return points_to_numpy(ball(vec3(center), radius, spacing, dimensions));
      },
      "center"_a, "radius"_a, "spacing"_a, "dimensions"_a = 3);
}

}  // namespace pbf
