#pragma once

#include "pbf/core/types.hpp"

namespace pbf::test {

/// Particles at the whole numbers from 0 on, so many along each axis.
inline Points lattice(int nx, int ny, int nz) {
  Points x(3, nx * ny * nz);
  for (Index i = 0; i < x.cols(); ++i)
    x.col(i) = Eigen::Vector3<Index>(i % nx, i / nx % ny, i / (nx * ny)).cast<Real>();
  return x;
}

}  // namespace pbf::test
