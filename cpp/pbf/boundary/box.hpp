#pragma once

#include "pbf/core/fields.hpp"

#include <array>
#include <cmath>
#include <limits>

namespace pbf {

/// Something about each of the three axes.
using Axes = std::array<bool, 3>;

/// An axis-aligned tank: particles stay in the closed box [lower, upper]. Along a periodic axis it
/// has no walls: what leaves it there comes in at the opposite face, and fluid at the one face is
/// next to fluid at the other.
struct Box {
  Vec3 lower{0.0F, 0.0F, 0.0F};
  Vec3 upper{1.0F, 1.0F, 1.0F};
  Axes periodic{false, false, false};

  /// The point of the box nearest to x: collision response without friction or bounce.
  /// What is not a number stays so, to be found and reported at the end of the step.
  [[nodiscard]] Vec3 project(const Vec3& x) const {
    return {project(0, x[0]), project(1, x[1]), project(2, x[2])};
  }
  /// The same for one coordinate.
  [[nodiscard]] Real project(int axis, Real x) const {
    const Real raised = x < lower[axis] ? lower[axis] : x;
    return raised > upper[axis] ? upper[axis] : raised;
  }
  /// The coordinate in [lower, upper) that stands for x along a periodic axis, x itself along
  /// another. What is no number, or too far off to be told from its images, stays so, to be found
  /// and reported in the step.
  [[nodiscard]] Real wrap(int axis, Real x) const {
    if (!periodic[static_cast<std::size_t>(axis)]) return x;
    if (x >= lower[axis] && x < upper[axis]) return x;
    const auto from = static_cast<double>(lower[axis]);
    const double period = static_cast<double>(upper[axis]) - from;
    const double periods = (static_cast<double>(x) - from) / period;
    if (!(std::abs(periods) < 1 << 20)) return x;
    const auto wrapped = static_cast<Real>(static_cast<double>(x) - std::floor(periods) * period);
    return wrapped >= lower[axis] && wrapped < upper[axis] ? wrapped : lower[axis];
  }
  [[nodiscard]] bool is_periodic() const { return periodic[0] || periodic[1] || periodic[2]; }
  /// Axes along which fluid of so many dimensions meets no walls.
  [[nodiscard]] Axes without_walls(int dimensions) const {
    return {periodic[0], periodic[1], periodic[2] || dimensions == 2};
  }
  /// The box that reaches to infinity along some axes.
  [[nodiscard]] Box open_along(const Axes& axes) const {
    Box box = *this;
    constexpr Real infinity = std::numeric_limits<Real>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
      if (!axes[static_cast<std::size_t>(axis)]) continue;
      box.lower[axis] = -infinity;
      box.upper[axis] = infinity;
    }
    return box;
  }
  [[nodiscard]] bool contains(const Vec3& x) const {
    return (x.array() >= lower.array()).all() && (x.array() <= upper.array()).all();
  }

  static constexpr const char* kName = "Box";
  static auto fields() {
    return std::tuple{
        Field{"lower", &Box::lower, "m", between(-1e9, 1e9),
              "Corner with the smallest coordinates."},
        Field{"upper", &Box::upper, "m", between(-1e9, 1e9),
              "Corner with the largest coordinates."},
        Field{"periodic", &Box::periodic, "", anything(),
              "Axes along which there are no walls: what leaves the box there comes in at the "
              "opposite face, and fluid at the one face is next to fluid at the other."},
    };
  }
  void check_together(Faults& faults) const {
    if (!(upper.array() > lower.array()).all()) {
      faults.add("upper", upper, "m",
                 "must be greater than lower = " + to_text(lower) + " m on every axis");
    }
  }
};

}  // namespace pbf
