#pragma once

#include "pbf/boundary/box.hpp"

#include <array>
#include <cmath>

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

  /// Calls f(q) for every boundary particle with ‖x − q‖ < h. x lies in the box.
  template <class F>
  void for_each_near(const Vec3& x, F&& f) const {
    if (((x - walls_.lower).array() >= h_).all() && ((walls_.upper - x).array() >= h_).all())
      return;
    const std::array<Sites, 3> sites{sites_near(0, x[0]), sites_near(1, x[1]), sites_near(2, x[2])};
    const Real h2 = h_ * h_;
    for (int c = 0; c < sites[2].size; ++c) {
      const Real z2 = square(x[2] - sites[2].at[c]);
      for (int b = 0; b < sites[1].size; ++b) {
        const Real yz2 = square(x[1] - sites[1].at[b]) + z2;
        if (!(yz2 < h2)) continue;
        const auto visit = [&](int first, int end) {
          for (int a = first; a < end; ++a) {
            if (square(x[0] - sites[0].at[a]) + yz2 < h2) {
              f(Vec3{sites[0].at[a], sites[1].at[b], sites[2].at[c]});
            }
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
  }

 private:
  /// Coordinates of the sites within h of a coordinate, in ascending order.
  struct Sites {
    // h is at most 4 d and inner cells at least 2/3 d: 2 · (4 + 1) outside and 2 · 4 / (2/3) + 2
    // inside.
    std::array<Real, 24> at;
    int size = 0;
    int first_inside = 0;
    int end_inside = 0;
    [[nodiscard]] bool inside(int k) const { return k >= first_inside && k < end_inside; }
  };
  [[nodiscard]] Sites sites_near(int axis, Real x) const;
  static Real square(Real a) { return a * a; }

  Box walls_;  // infinite where there are none
  Real spacing_, h_;
  int dimensions_, layers_;
  std::array<Index, 3> cells_{};
  Vec3 first_cell_, cell_size_;
};

}  // namespace pbf
