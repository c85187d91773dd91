#pragma once

#include "pbf/scene/shapes.hpp"

#include <random>
#include <set>
#include <utility>
#include <vector>

/// Particle sets and slow answers that several tests share.
namespace pbf::samples {

/// A block of particles, each moved by at most `share` of the spacing along every axis.
inline Points jittered_block(
    const Vec3& lower, const Vec3& upper, Real spacing, Real share, unsigned seed = 1) {
  Points x = block(lower, upper, spacing);
  std::mt19937 random(seed);
  std::uniform_real_distribution<Real> offset(-share * spacing, share * spacing);
  for (Index i = 0; i < x.cols(); ++i) {
    for (int axis = 0; axis < 3; ++axis) x(axis, i) += offset(random);
  }
  return x;
}

/// All ordered pairs closer than h, by looking at every pair.
inline std::set<std::pair<Index, Index>> pairs_by_brute_force(const Points& x, Real h) {
  std::set<std::pair<Index, Index>> pairs;
  for (Index i = 0; i < x.cols(); ++i) {
    for (Index j = 0; j < x.cols(); ++j) {
      if (i != j && (x.col(i) - x.col(j)).squaredNorm() < h * h) pairs.emplace(i, j);
    }
  }
  return pairs;
}

}  // namespace pbf::samples
