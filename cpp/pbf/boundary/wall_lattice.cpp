#include "pbf/boundary/wall_lattice.hpp"

#include <algorithm>

namespace pbf {

WallLattice::WallLattice(const Box& box, Real spacing, Real h, int dimensions)
    : walls_(box.open_along(box.without_walls(dimensions))),
      spacing_(spacing),
      h_(h),
      dimensions_(dimensions),
      layers_(static_cast<int>(std::ceil(h / spacing))),
      first_cell_(box.lower) {
  for (int axis = 0; axis < dimensions; ++axis) {
    const double length =
        static_cast<double>(box.upper[axis]) - static_cast<double>(box.lower[axis]);
    cells_[axis] = std::max<Index>(1, std::llround(length / static_cast<double>(spacing)));
    cell_size_[axis] = static_cast<Real>(length / static_cast<double>(cells_[axis]));
    if (!box.periodic[static_cast<std::size_t>(axis)]) continue;
    const auto beyond = static_cast<Index>(std::ceil(h / cell_size_[axis])) + 1;
    cells_[axis] += 2 * beyond;
    first_cell_[axis] -= static_cast<Real>(beyond) * cell_size_[axis];
  }
}

WallLattice::Sites WallLattice::sites_near(int axis, Real x) const {
  Sites sites;
  if (axis >= dimensions_) {
    sites.at[0] = x;
    sites.size = sites.end_inside = 1;
    return sites;
  }
  const auto add_if_near = [&](Real at) {
    if (std::abs(x - at) < h_) sites.at[static_cast<std::size_t>(sites.size++)] = at;
  };
  const Real from_lower = x - walls_.lower[axis];
  const Real to_upper = walls_.upper[axis] - x;

  if (from_lower < h_) {
    for (int k = layers_ - 1; k >= 0; --k) {
      add_if_near(walls_.lower[axis] - (static_cast<Real>(k) + 0.5F) * spacing_);
    }
  }
  sites.first_inside = sites.size;
  const Real size = cell_size_[axis];
  const Real from_first = x - first_cell_[axis];
  // Casts cut off, which from zero on is floor; one site too many is not near.
  const Real half = size / 2;
  const Index first = std::max<Index>(0, static_cast<Index>((from_first - h_ - half) / size));
  const Index last =
      std::min<Index>(cells_[axis] - 1, static_cast<Index>((from_first + h_ + half) / size));
  for (Index k = first; k <= last; ++k) {
    add_if_near(first_cell_[axis] + (static_cast<Real>(k) + 0.5F) * size);
  }
  sites.end_inside = sites.size;
  if (to_upper < h_) {
    for (int k = 0; k < layers_; ++k) {
      add_if_near(walls_.upper[axis] + (static_cast<Real>(k) + 0.5F) * spacing_);
    }
  }
  return sites;
}

}  // namespace pbf
