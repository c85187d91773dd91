#pragma once

#include "pbf/core/fields.hpp"

#include <limits>

namespace pbf {

/// An axis-aligned tank: particles stay in the closed box [lower, upper].
struct Box {
  Vec3 lower{0.0F, 0.0F, 0.0F};
  Vec3 upper{1.0F, 1.0F, 1.0F};

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
  /// The box that reaches to infinity along the axes from number `dimensions` on.
  [[nodiscard]] Box open_beyond(int dimensions) const {
    Box box = *this;
    constexpr Real infinity = std::numeric_limits<Real>::infinity();
    for (int axis = dimensions; axis < 3; ++axis) {
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
