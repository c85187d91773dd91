#pragma once

#include "pbf/fluid/discretization.hpp"

#include <bit>
#include <vector>

namespace pbf {

/// x* = project(x + dt (v + dt g)): where a particle would be without the others, moved out of the
/// walls. Algorithm 1, lines 1–4 [MM13]. v itself is not changed: the velocity update reads the
/// displacement u = x* − x only.
///
/// u is kept beside x* and added up from its parts. The difference of the positions would carry
/// their rounding into the velocities, EPS ‖x‖/dt, alike for all particles that share a coordinate:
/// drops in open space would gain momentum, the more the farther from the origin.
class Prediction {
 public:
  Prediction(const Discretization& disc, Real dt);

  void operator()(const Record& x, const Record& v, Record& x_star, Record& u) const {
    const Numbers from = numbers(x), way = dt_ * (numbers(v) + dv_), moved = from + way;
    // What is not a number stays so, to be found and reported.
    const Numbers raised = moved < lower_ ? lower_ : moved;
    const Numbers to = raised > upper_ ? upper_ : raised;
    // A wall leaves the way to it.
    const Numbers gone = to == moved ? way : to - from;
    x_star = std::bit_cast<Record>(to);
    u = std::bit_cast<Record>(gone);
  }

 private:
  /// The four numbers of a record: the fourth leave x.w as it is, and u.w zero.
  using Numbers = Real __attribute__((vector_size(sizeof(Record))));
  static Numbers numbers(const Record& a) { return std::bit_cast<Numbers>(a); }
  Numbers dt_, dv_, lower_, upper_;
};

/// The same for all particles, which along periodic axes are moved back into the domain; u knows
/// nothing of that.
void predict(const Records& x,
             const Records& v,
             const Discretization& disc,
             Real dt,
             int threads,
             Records& x_star,
             Records& u);

/// v = u/dt = (x* − x)/dt, Algorithm 1, line 20 [MM13]; totals are u's fourth numbers.
void update_velocity(const Records& u, Real dt, int threads, Records& v, std::vector<Real>& totals);

}  // namespace pbf
