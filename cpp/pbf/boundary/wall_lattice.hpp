#pragma once

#include "pbf/boundary/box.hpp"

#include <array>
#include <cstddef>

namespace pbf {

/// The boundary particles of a box: a closely packed lattice outside its walls, thick enough to
/// fill the support radius, first layer half a spacing outside. It is never stored; sites are
/// counted off where a particle is near, so a large box costs only where the fluid is.
///
/// On each axis the sites are  lower − (k + ½) d  and  upper + (k + ½) d  outside, k = 0 …
/// ceil(h/d) − 1, and the centers of round(L/d) equal cells inside, so that the lattice fits both
/// walls. The boundary particles are all combinations of three coordinates but those with all three
/// inside. A periodic axis has no walls, and the cells inside go on beyond its faces. In 2-D the
/// only site along z is the particle's own z: lines around the fluid's plane.
class WallLattice {
 public:
  WallLattice(const Box& box, Real spacing, Real h, int dimensions = 3);

  /// Writes every boundary particle with ‖x − q‖ < h, one behind the other, and returns the place
  /// behind the last. x lies in the box. Writes on the way to any of most_near() places.
  Vec3* collect_near(const Vec3& x, Vec3* to) const;
  [[nodiscard]] std::size_t most_near() const;

 private:
  // Sites that are tried on an axis: h is at most 4 d and inner cells at least 2/3 d, so that there
  // are 2 · 4 outside and 2 · 4 / (2/3) + 4 inside.
  static constexpr int kMostSites = 24;

  /// Coordinates of the sites within h of a coordinate, in ascending order.
  struct Sites {
    std::array<Real, kMostSites + 1> at;
    int size = 0;
    int first_inside = 0;
    int end_inside = 0;
    [[nodiscard]] bool inside(int k) const { return k >= first_inside && k < end_inside; }
  };
  [[nodiscard]] Sites sites_near(int axis, Real x) const;
  Box walls_;  // infinite where there are none
  Real spacing_, h_;
  int dimensions_, layers_;
  std::array<Index, 3> cells_{};
  Vec3 first_cell_, cell_size_, cells_per_length_;
};

}  // namespace pbf
