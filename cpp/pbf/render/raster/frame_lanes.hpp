#pragma once

#include "pbf/core/lanes.hpp"

/// Of glsl/frame.glsl, where it is explained, what the loops over pixels need.
namespace pbf::PBF_ISA_NAMESPACE {

inline constexpr float kLeastSurface = -1e29F;  // affine depth

PBF_INLINE Lanes crowding_of(Lanes a) {
  const auto level = reinterpret_cast<Mask::Vector>(a.v) & 3;
  return Lanes(1) - Lanes(__builtin_convertvector(level, Lanes::Vector)) / Lanes(3);
}

PBF_INLINE Lanes farther(bool perspective, Lanes a, float length) {
  if (!perspective) return Lanes(length);
  return a * a * Lanes(length) / (Lanes(1) + a * Lanes(length));
}
PBF_INLINE Lanes nearer(bool perspective, Lanes a, float length) {
  if (!perspective) return Lanes(length);
  const Lanes share = min(a * Lanes(length), Lanes(0.5F));
  return a * share / (Lanes(1) - share);
}

}  // namespace pbf::PBF_ISA_NAMESPACE
