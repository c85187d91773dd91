#include "pbf/fluid/density_constraint.hpp"
#include "pbf/fluid/predict.hpp"
#include "pbf/fluid/vorticity.hpp"
#include "pbf/fluid/xsph.hpp"
#include "pbf/neighbors/reorder.hpp"

#include "bind_params.hpp"
#include "numpy_io.hpp"
#include <span>

/// The solver's stages one by one, for tests against the plain reference and for teaching: arrays
/// in, arrays out, particles in the order they come. Each call searches neighbors anew; a
/// simulation does it once per step.
namespace pbf {
namespace {

using OptionalBox = std::optional<Box>;

/// Positions sorted by cell with their neighborhood, and the way back.
struct Sorted {
  CellGrid grid;
  Records x;
  Neighborhood near;

  Sorted(const PointsView& positions, const Discretization& disc) {
    Records unsorted = records_of(positions);
    near.sort(unsorted, disc, 0, grid);
    x = sort(positions);
    near.build(grid, disc, 0, x);
  }
  /// Of the particles; ghosts stand behind them in records.
  [[nodiscard]] std::span<const std::uint32_t> order() const {
    return std::span(grid.order()).first(static_cast<std::size_t>(grid.particles()));
  }
  [[nodiscard]] Records sort(const PointsView& a) const {
    return records_of(gathered(Points(a), order()));
  }
  [[nodiscard]] py::array_t<float> unsort(const Records& sorted) const {
    const Points points = points_of(sorted).leftCols(grid.particles());
    return points_to_numpy(scattered(points, order()));
  }
  [[nodiscard]] py::array_t<float> unsort(const Scalars& sorted) const {
    const Scalars scalars = sorted.head(grid.particles());
    return scalars_to_numpy(scattered(scalars, order()));
  }
};

py::tuple calibration_of(const FluidParams& fluid) {
  const Calibration c =
      calibrate(fluid.kernel_in_force(), fluid.dimensions, static_cast<double>(fluid.spacing),
                static_cast<double>(fluid.h()));
  return py::make_tuple(c.volume, c.ideal_denominator);
}

py::tuple kernel_of(const FluidParams& fluid, const py::object& r) {
  const FloatArray array = points_array(r, "r");
  const auto view = points_view(array);
  Scalars W(view.cols());
  Points grad(3, view.cols());
  with_kernel(fluid.kernel_in_force(), fluid.dimensions, fluid.h(), [&](const auto& kernel) {
    for (Index i = 0; i < view.cols(); ++i) {
      const Real r2 = view.col(i).squaredNorm();
      W[i] = kernel.W(r2);
      grad.col(i) = -kernel.slope(r2) * view.col(i);
    }
  });
  return py::make_tuple(scalars_to_numpy(std::move(W)), points_to_numpy(std::move(grad)));
}

py::tuple neighbor_pairs(const py::object& positions, Real h) {
  const FloatArray array = points_array(positions, "positions");
  const auto view = points_view(array);
  CellGrid grid;
  grid.build(records_of(view), h, 0);
  NeighborList list;
  list.build(grid, records_of(gathered(Points(view), grid.order())), h, 0);
  std::vector<std::pair<std::int64_t, std::int64_t>> pairs;
  for (Index k = 0; k < list.size(); ++k) {
    for (const std::uint32_t j : list[k])
      pairs.emplace_back(grid.order()[static_cast<std::size_t>(k)], grid.order()[j]);
  }
  std::sort(pairs.begin(), pairs.end());
  Ids first(static_cast<Index>(pairs.size())), second(static_cast<Index>(pairs.size()));
  for (Index p = 0; p < first.size(); ++p) {
    std::tie(first[p], second[p]) = pairs[static_cast<std::size_t>(p)];
  }
  const py::ssize_t n = first.size();
  return py::make_tuple(to_numpy(std::move(first), {n}), to_numpy(std::move(second), {n}));
}

py::tuple boundary_particles(const py::object& positions,
                             const FluidParams& fluid,
                             const OptionalBox& box) {
  const FloatArray array = points_array(positions, "positions");
  const Discretization disc(fluid, box);
  BoundaryList list;
  list.build(disc.walls, records_of(points_view(array)), array.shape(0), 4, 0);
  std::vector<Vec3> sites;
  Ids offsets(array.shape(0) + 1);
  offsets[0] = 0;
  for (Index i = 0; i < array.shape(0); ++i) {
    const std::vector<Vec3> row = list[i];
    sites.insert(sites.end(), row.begin(), row.end());
    offsets[i + 1] = static_cast<Index>(sites.size());
  }
  Points q(3, static_cast<Index>(sites.size()));
  for (Index k = 0; k < q.cols(); ++k) q.col(k) = sites[static_cast<std::size_t>(k)];
  const py::ssize_t n = offsets.size();
  return py::make_tuple(to_numpy(std::move(offsets), {n}), points_to_numpy(std::move(q)));
}

py::tuple predict_stage(const py::object& positions,
                        const py::object& velocities,
                        const FluidParams& fluid,
                        const OptionalBox& box,
                        Real dt) {
  const FloatArray x = points_array(positions, "positions");
  const FloatArray v = points_array(velocities, "velocities");
  const Discretization disc(fluid, box);
  Records x_star, u;
  predict(records_of(points_view(x)), records_of(points_view(v)), disc, dt, 0, x_star, u);
  Points v_predicted = points_view(v).colwise() + Vec3(dt * fluid.gravity);
  return py::make_tuple(points_to_numpy(std::move(v_predicted)),
                        points_to_numpy(points_of(x_star)));
}

py::tuple multipliers_stage(const py::object& x_star,
                            const FluidParams& fluid,
                            const SolverParams& solver,
                            const OptionalBox& box) {
  const FloatArray x = points_array(x_star, "x_star");
  const Discretization disc(fluid, box);
  const Sorted sorted(points_view(x), disc);
  Records density, x_lambda;
  relative_densities(sorted.near, disc, sorted.x, 0, density);
  solve_multipliers(sorted.near, disc, solver, sorted.x, x_lambda);
  const Scalars rho = fluid.rest_density * scalars_of(density);
  return py::make_tuple(sorted.unsort(rho), sorted.unsort(scalars_of(x_lambda)));
}

py::array_t<float> corrections_stage(const py::object& x_star,
                                     const py::object& multipliers,
                                     const FluidParams& fluid,
                                     const SolverParams& solver,
                                     const OptionalBox& box) {
  const FloatArray x = points_array(x_star, "x_star");
  const FloatArray lambda = scalars_array(multipliers, "multipliers");
  require_rows(lambda, "multipliers", x.shape(0), "x_star");
  Discretization disc(fluid, box);
  const Sorted sorted(points_view(x), disc);
  Records x_lambda = sorted.x;
  for (Index k = 0; k < lambda.size(); ++k)
    x_lambda[k].w = lambda.at(sorted.order()[static_cast<std::size_t>(k)]);
  sorted.near.ghosts.refresh_positions(x_lambda, 0);
  // Without collision a particle that starts from no displacement ends with its correction.
  disc.centers.reset();
  Records moved(sorted.x.size()), dp(sorted.x.size());
  apply_corrections(sorted.near, disc, solver, x_lambda, sorted.x, moved, dp);
  return sorted.unsort(dp);
}

py::array_t<float> project_stage(const py::object& positions, const OptionalBox& box) {
  const FloatArray array = points_array(positions, "positions");
  Points x = points_view(array);
  if (box) {
    for (Index i = 0; i < x.cols(); ++i) x.col(i) = box->project(x.col(i));
  }
  return points_to_numpy(std::move(x));
}

py::array_t<float> vorticity_stage(const py::object& positions,
                                   const py::object& velocities,
                                   const FluidParams& fluid) {
  const FloatArray x = points_array(positions, "positions");
  const FloatArray v = points_array(velocities, "velocities");
  require_rows(v, "velocities", x.shape(0), "positions");
  const Discretization disc(fluid);
  const Sorted sorted(points_view(x), disc);
  Records omega, x_strength;
  compute_vorticity(sorted.near, disc, sorted.x, sorted.sort(points_view(v)), 0, omega, x_strength);
  return sorted.unsort(omega);
}

py::array_t<float> confine_stage(const py::object& positions,
                                 const py::object& velocities,
                                 const py::object& omegas,
                                 const FluidParams& fluid,
                                 Real strength,
                                 Real dt) {
  const FloatArray x = points_array(positions, "positions");
  const FloatArray v = points_array(velocities, "velocities");
  const FloatArray omega = points_array(omegas, "omega");
  require_rows(v, "velocities", x.shape(0), "positions");
  require_rows(omega, "omega", x.shape(0), "positions");
  const Discretization disc(fluid);
  const Sorted sorted(points_view(x), disc);
  Records v_new = sorted.sort(points_view(v)), x_strength = sorted.x;
  const Records omega_sorted = sorted.sort(points_view(omega));
  for (Index k = 0; k < x_strength.size(); ++k) x_strength[k].w = vec3(omega_sorted[k]).norm();
  confine_vorticity(sorted.near, disc, x_strength, omega_sorted, strength, dt, 0, v_new);
  return sorted.unsort(v_new);
}

py::array_t<float> xsph_stage(const py::object& positions,
                              const py::object& velocities,
                              const FluidParams& fluid,
                              Real strength) {
  const FloatArray x = points_array(positions, "positions");
  const FloatArray v = points_array(velocities, "velocities");
  require_rows(v, "velocities", x.shape(0), "positions");
  const Discretization disc(fluid);
  const Sorted sorted(points_view(x), disc);
  Records v_new;
  smooth_velocities(sorted.near, disc, sorted.x, sorted.sort(points_view(v)), strength, 0, v_new);
  return sorted.unsort(v_new);
}

}  // namespace

void register_stages(py::module_& m) {
  py::module_ stages = m.def_submodule(
      "stages", "The solver's stages one by one; each call searches neighbors anew.");
  stages.def("calibration", &calibration_of, "fluid"_a, "(V [m^3], D_ideal [1/m^2]).");
  stages.def("kernel", &kernel_of, "fluid"_a, "r"_a,
             "(W [1/m^3], grad W [1/m^4]) at the offsets r [m].");
  stages.def("neighbor_pairs", &neighbor_pairs, "positions"_a, "h"_a,
             "(i, j) of all pairs closer than h, sorted.");
  stages.def("boundary_particles", &boundary_particles, "positions"_a, "fluid"_a, "box"_a,
             "(offsets, q): row i's boundary particles are q[offsets[i]:offsets[i + 1]] [m].");
  stages.def("predict", &predict_stage, "positions"_a, "velocities"_a, "fluid"_a, "box"_a, "dt"_a,
             "(v + dt g [m/s], x* [m]).");
  stages.def("multipliers", &multipliers_stage, "x_star"_a, "fluid"_a, "solver"_a, "box"_a,
             "(densities [kg/m^3], multipliers [m^2]).");
  stages.def("corrections", &corrections_stage, "x_star"_a, "multipliers"_a, "fluid"_a, "solver"_a,
             "box"_a, "Corrections [m].");
  stages.def("project", &project_stage, "positions"_a, "box"_a,
             "The nearest points in the box [m].");
  stages.def("vorticity", &vorticity_stage, "positions"_a, "velocities"_a, "fluid"_a,
             "Vorticity [1/s].");
  stages.def("confine", &confine_stage, "positions"_a, "velocities"_a, "omega"_a, "fluid"_a,
             "strength"_a, "dt"_a, "Velocities after vorticity confinement [m/s].");
  stages.def("xsph", &xsph_stage, "positions"_a, "velocities"_a, "fluid"_a, "strength"_a,
             "Velocities after XSPH [m/s].");
}

}  // namespace pbf
