#pragma once

#include "pbf/fluid/slices.hpp"

/// The sums of fluid/xsph.hpp and of densities, which need the same W.
namespace pbf::PBF_ISA_NAMESPACE {

template <class Kernel>
PBF_INLINE Lanes wall_density(const Kernel& VW, const Slice& slice, const Vec3Lanes& x_i) {
  Lanes density = 0;
  slice.for_each_wall([&](const Vec3Lanes& q) PBF_LAMBDA_INLINE {
    const Vec3Lanes r = x_i - q;
    density += VW.W(dot(r, r));
  });
  return density;
}

template <class Kernel>
void densities(const Kernel& VW, const Stretch& at, const Record* x, Record* result) {
  for_each_slice(at, [&](const Slice& slice) PBF_LAMBDA_INLINE {
    const Vec3Lanes x_i = load_records(x + slice.first).xyz;
    Lanes density = VW.W(Lanes(0));
    slice.for_each_neighbor([&](const std::uint32_t* j) PBF_LAMBDA_INLINE {
      const Vec3Lanes r = x_i - gather(x, j).xyz;
      density += VW.W(dot(r, r));
    });
    store_records(result + slice.first, load_records(result + slice.first).xyz,
                  density + wall_density(VW, slice, x_i));
  });
}

template <class Kernel>
void xsph(const Kernel& VW,
          const Stretch& at,
          Real strength,
          const Record* x,
          const Record* v,
          Record* v_new) {
  for_each_slice(at, [&](const Slice& slice) PBF_LAMBDA_INLINE {
    const Vec3Lanes x_i = load_records(x + slice.first).xyz;
    const Vec3Lanes v_i = load_records(v + slice.first).xyz;
    Lanes density = VW.W(Lanes(0));
    Vec3Lanes sum = {0, 0, 0};
    slice.for_each_neighbor([&](const std::uint32_t* j) PBF_LAMBDA_INLINE {
      const Vec3Lanes r = x_i - gather(x, j).xyz;
      const Lanes VW_ij = VW.W(dot(r, r));
      density += VW_ij;
      sum += VW_ij * (gather(v, j).xyz - v_i);
    });
    store_records(v_new + slice.first, v_i + Lanes(strength) * sum,
                  density + wall_density(VW, slice, x_i));
  });
}

}  // namespace pbf::PBF_ISA_NAMESPACE
