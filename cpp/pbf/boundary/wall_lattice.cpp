#include "pbf/boundary/wall_lattice.hpp"

#include <algorithm>
#include <cmath>

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
    cells_per_length_[axis] = 1 / cell_size_[axis];
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
  // Written in any case: a jump that a processor cannot foresee costs more than the rest.
  const auto add_if_near = [&](Real at) {
    sites.at[static_cast<std::size_t>(sites.size)] = at;
    sites.size += std::abs(x - at) < h_ ? 1 : 0;
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
  const Real per_length = cells_per_length_[axis];
  const Index first = std::max<Index>(0, static_cast<Index>((from_first - h_ - half) * per_length));
  const Index last =
      std::min<Index>(cells_[axis] - 1, static_cast<Index>((from_first + h_ + half) * per_length));
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

std::size_t WallLattice::most_near() const {
  const auto most = static_cast<std::size_t>(kMostSites);
  return most * most * (dimensions_ == 2 ? 1 : most);
}

Vec3* WallLattice::collect_near(const Vec3& x, Vec3* to) const {
  if (((x - walls_.lower).array() >= h_).all() && ((walls_.upper - x).array() >= h_).all()) {
    return to;
  }
  const std::array<Sites, 3> sites{sites_near(0, x[0]), sites_near(1, x[1]), sites_near(2, x[2])};
  const Real h2 = h_ * h_;
  for (int c = 0; c < sites[2].size; ++c) {
    const Real z = sites[2].at[static_cast<std::size_t>(c)];
    const Real z2 = square(x[2] - z);
    for (int b = 0; b < sites[1].size; ++b) {
      const Real y = sites[1].at[static_cast<std::size_t>(b)];
      const Real yz2 = square(x[1] - y) + z2;
      const auto visit = [&](int first, int end) {
        for (int a = first; a < end; ++a) {
          const Real at = sites[0].at[static_cast<std::size_t>(a)];
          *to = {at, y, z};
          to += square(x[0] - at) + yz2 < h2 ? 1 : 0;
        }
      };
      if (sites[2].inside(c) && sites[1].inside(b)) {
        visit(0, sites[0].first_inside);
        visit(sites[0].end_inside, sites[0].size);
      } else {
        visit(0, sites[0].size);
      }
    }
  }
  return to;
}

}  // namespace pbf
