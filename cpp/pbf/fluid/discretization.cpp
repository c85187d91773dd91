#include "pbf/fluid/discretization.hpp"

namespace pbf {
namespace {

void check_periods(const Box& domain, const FluidParams& params) {
  if (params.dimensions == 2 && domain.periodic[2]) {
    throw InvalidParameter("domain: periodic = " + to_text(domain.periodic) +
                           "; z must be false in 2-D, where the domain has no z");
  }
  const double h = static_cast<double>(params.h());
  for (int axis = 0; axis < 3; ++axis) {
    if (!domain.periodic[static_cast<std::size_t>(axis)]) continue;
    const double period =
        static_cast<double>(domain.upper[axis]) - static_cast<double>(domain.lower[axis]);
    if (period < 2 * h || period > kFarthestCell * h) {
      throw InvalidParameter(
          "domain: its period of " + to_text(period) + " m along " + "xyz"[axis] + " must be >= " +
          to_text(2 * h) + " m (2 support radii, or a particle would have two images of another " +
          "as neighbors) and <= " + to_text(kFarthestCell * h) + " m (2^20 support radii)");
    }
  }
}

}  // namespace

Discretization::Discretization(const FluidParams& params, const std::optional<Box>& box)
    : fluid(params), domain(box), h(params.h()) {
  validate(params);
  // Of the rest lattice: find(choice, dimensions, spacing, h).
  const auto of_lattice = [&](const auto& find) {
    return find(params.kernel_in_force(), params.dimensions, static_cast<double>(params.spacing),
                static_cast<double>(params.h()));
  };
  const Calibration calibration = of_lattice(calibrate);
  V = static_cast<Real>(calibration.volume);
  ideal_denominator = static_cast<Real>(calibration.ideal_denominator);
  largest_eigenvalue = static_cast<Real>(of_lattice(pbf::largest_eigenvalue));
  if (!domain) return;
  validate(*domain);
  const Vec3 size = domain->upper - domain->lower;
  if ((size.array() < params.spacing).head(params.dimensions).any()) {
    throw InvalidParameter("domain: its size " + to_text(size) +
                           " m must be at least the spacing (" + to_text(params.spacing) +
                           " m) on every axis" + (params.dimensions == 2 ? " but z" : ""));
  }
  check_periods(*domain, params);
  const Vec3 radius = Vec3::Constant(params.spacing / 2);
  centers = Box{.lower = domain->lower + radius, .upper = domain->upper - radius}.open_along(
      domain->without_walls(params.dimensions));
  walls.emplace(*domain, params.spacing, h, params.dimensions);
}

void Neighborhood::sort(Records& x, const Discretization& disc, int threads, CellGrid& grid) {
  const Index particles = x.size();
  ghosts.append(disc.domain, disc.h, x, threads);
  grid.build(x, particles, disc.h, threads);
  ghosts.reorder(grid.order(), threads);
}

void Neighborhood::build(const CellGrid& grid,
                         const Discretization& disc,
                         int threads,
                         Records& x) {
  ghosts.refresh_positions(x, threads);
  fluid.build(grid, x, disc.h, threads);
  boundary.build(disc.walls, x, fluid.size(), fluid.lanes(), threads);
}

}  // namespace pbf
