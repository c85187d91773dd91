#pragma once

#include "pbf/core/fields.hpp"

#include <array>
#include <numbers>

namespace pbf {

/// Which functions stand for W and grad W.
enum class KernelChoice { poly6_spiky, cubic_spline };

template <>
struct Choices<KernelChoice> {
  static constexpr std::array names{"poly6_spiky", "cubic_spline"};
};

}  // namespace pbf
