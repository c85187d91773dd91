#include "pbf/fluid/discretization.hpp"

namespace pbf {
namespace {

Calibration checked_calibration(const FluidParams& params) {
  validate(params);
  return calibrate(params.kernel_in_force(), params.dimensions, static_cast<double>(params.spacing),
                   static_cast<double>(params.h()));
}

}  // namespace

Discretization::Discretization(const FluidParams& params, const std::optional<Box>& box)
    : fluid(params), domain(box), h(params.h()) {
  const Calibration calibration = checked_calibration(params);
  V = static_cast<Real>(calibration.volume);
  ideal_denominator = static_cast<Real>(calibration.ideal_denominator);
  largest_eigenvalue = static_cast<Real>(calibration.largest_eigenvalue);
  if (!domain) return;
  validate(*domain);
  const Vec3 size = domain->upper - domain->lower;
  if ((size.array() < params.spacing).head(params.dimensions).any()) {
    throw InvalidParameter("domain: its size " + to_text(size) +
                           " m must be at least the spacing (" + to_text(params.spacing) +
                           " m) on every axis" + (params.dimensions == 2 ? " but z" : ""));
  }
  const Vec3 radius = Vec3::Constant(params.spacing / 2);
  centers = Box{.lower = domain->lower + radius, .upper = domain->upper - radius}.open_beyond(
      params.dimensions);
  walls.emplace(*domain, params.spacing, h, params.dimensions);
}

void Neighborhood::build(const CellGrid& grid,
                         const Records& x,
                         const Discretization& disc,
                         int threads) {
  fluid.build(grid, x, disc.h, threads);
  boundary.build(disc.walls, x, fluid.lanes(), threads);
}

}  // namespace pbf
