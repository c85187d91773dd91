#pragma once

// For raster/splats_lanes.cpp, compiled once per instruction set.
#include "pbf/core/lanes.hpp"
#include "pbf/render/raster/splat_kernels.hpp"

namespace pbf::PBF_ISA_NAMESPACE {

/// Symmetric matrices. A stretch G makes an ellipsoid of the sphere of radius r; its volume is the
/// sphere's, det G = 1. So the way back is the adjugate of G, and the ellipsoid is the set of all
/// center + x with x^T (r^2 G^2)^-1 x <= 1.
struct Symmetric {
  Lanes xx, yy, zz, xy, xz, yz;
};

PBF_INLINE Symmetric load_symmetric(const Record* from) {
  const RecordLanes diagonal =
      records_at([&](int lane) PBF_LAMBDA_INLINE { return from + 2 * lane; });
  const RecordLanes beside =
      records_at([&](int lane) PBF_LAMBDA_INLINE { return from + 2 * lane + 1; });
  return {diagonal.xyz.x, diagonal.xyz.y, diagonal.xyz.z, beside.xyz.x, beside.xyz.y, beside.xyz.z};
}

PBF_INLINE void store_symmetric(Record* to, const Symmetric& a) {
  Record diagonal[kLanes], beside[kLanes];
  store_records(diagonal, {a.xx, a.yy, a.zz}, 0.0F);
  store_records(beside, {a.xy, a.xz, a.yz}, 0.0F);
  for (int lane = 0; lane < kLanes; ++lane) {
    to[2 * lane] = diagonal[lane];
    to[2 * lane + 1] = beside[lane];
  }
}

PBF_INLINE Vec3Lanes operator*(const Symmetric& a, const Vec3Lanes& v) {
  return {a.xx * v.x + a.xy * v.y + a.xz * v.z, a.xy * v.x + a.yy * v.y + a.yz * v.z,
          a.xz * v.x + a.yz * v.y + a.zz * v.z};
}

/// In eye space what is `a` in the world.
PBF_INLINE Symmetric turned(const Symmetric& a, const float* view) {
  const auto row = [&](int k) PBF_LAMBDA_INLINE {
    return Vec3Lanes{view[k], view[4 + k], view[8 + k]};
  };
  const Vec3Lanes x = row(0), y = row(1), z = row(2);
  const Vec3Lanes ax = a * x, ay = a * y, az = a * z;
  return {dot(x, ax), dot(y, ay), dot(z, az), dot(x, ay), dot(x, az), dot(y, az)};
}

/// The inverse where the determinant is 1.
PBF_INLINE Symmetric adjugate(const Symmetric& a) {
  return {a.yy * a.zz - a.yz * a.yz, a.xx * a.zz - a.xz * a.xz, a.xx * a.yy - a.xy * a.xy,
          a.xz * a.yz - a.xy * a.zz, a.xy * a.yz - a.xz * a.yy, a.xy * a.xz - a.yz * a.xx};
}

PBF_INLINE Symmetric squared(const Symmetric& a) {
  const Vec3Lanes x{a.xx, a.xy, a.xz}, y{a.xy, a.yy, a.yz}, z{a.xz, a.yz, a.zz};
  return {dot(x, x), dot(y, y), dot(z, z), dot(x, y), dot(x, z), dot(y, z)};
}

}  // namespace pbf::PBF_ISA_NAMESPACE
