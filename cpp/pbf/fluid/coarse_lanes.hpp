#pragma once

#include "pbf/fluid/slices.hpp"

/// The sums of fluid/coarse_level.hpp over neighbors j and boundary particles q.
namespace pbf::PBF_ISA_NAMESPACE {

template <class Kernel>
void coarse_motions(const Kernel& VW,
                    const Stretch& at,
                    const Record* x_pressed,
                    CoarseMotions& motions) {
  for_each_slice(at, [&](const Slice& slice) PBF_LAMBDA_INLINE {
    const RecordLanes i = load_records(x_pressed + slice.first);
    Vec3Lanes g = {0, 0, 0};
    Vec3Lanes diagonal = {0, 0, 0}, beside = {0, 0, 0};  // B_xx, B_yy, B_zz and B_yz, B_zx, B_xy
    slice.for_each_neighbor([&](const std::uint32_t* entries) PBF_LAMBDA_INLINE {
      const RecordLanes j = gather(x_pressed, entries);
      const Vec3Lanes r = i.xyz - j.xyz;
      const Lanes s = VW.slope(dot(r, r));
      g -= (i.w + j.w) * s * r;
      const Vec3Lanes sr = j.w * s * r;
      diagonal += Vec3Lanes{sr.x * r.x, sr.y * r.y, sr.z * r.z};
      beside += Vec3Lanes{sr.y * r.z, sr.z * r.x, sr.x * r.y};
    });
    slice.for_each_wall([&](const Vec3Lanes& q) PBF_LAMBDA_INLINE {
      const Vec3Lanes r = i.xyz - q;
      g -= i.w * VW.slope(dot(r, r)) * r;
    });
    const Index k = slice.first - at.first;
    store_records(motions.x.data() + k, {diagonal.x, beside.z, beside.y}, g.x);
    store_records(motions.y.data() + k, {beside.z, diagonal.y, beside.x}, g.y);
    store_records(motions.z.data() + k, {beside.y, beside.x, diagonal.z}, g.z);
  });
}

}  // namespace pbf::PBF_ISA_NAMESPACE
