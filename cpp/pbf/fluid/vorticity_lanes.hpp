#pragma once

#include "pbf/fluid/slices.hpp"

/// The sums of fluid/vorticity.hpp.
namespace pbf::PBF_ISA_NAMESPACE {

template <class Kernel>
void vorticity(const Kernel& VW,
               const Stretch& at,
               const Record* x,
               const Record* v,
               Record* omega,
               Record* x_strength) {
  for_each_slice(at, [&](const Slice& slice) PBF_LAMBDA_INLINE {
    const Vec3Lanes x_i = load_records(x + slice.first).xyz;
    const Vec3Lanes v_i = load_records(v + slice.first).xyz;
    Vec3Lanes curl = {0, 0, 0};
    slice.for_each_neighbor([&](const std::uint32_t* j) PBF_LAMBDA_INLINE {
      const Vec3Lanes r = x_i - gather(x, j).xyz;
      // (v_j − v_i) × ∇_j W with ∇_j W = −∇_i W = slope · r
      curl += VW.slope_in_units(dot(r, r)) * cross(gather(v, j).xyz - v_i, r);
    });
    curl = Lanes(VW.slope_unit) * curl;
    store_records(omega + slice.first, curl, 0);
    store_records(x_strength + slice.first, x_i, sqrt(dot(curl, curl)));
  });
}

template <class Kernel>
void confinement(const Kernel& VW,
                 const Stretch& at,
                 Real impulse,
                 const Record* x_strength,
                 const Record* omega,
                 Record* v) {
  for_each_slice(at, [&](const Slice& slice) PBF_LAMBDA_INLINE {
    const RecordLanes i = load_records(x_strength + slice.first);
    Vec3Lanes eta = {0, 0, 0};
    slice.for_each_neighbor([&](const std::uint32_t* entries) PBF_LAMBDA_INLINE {
      const RecordLanes j = gather(x_strength, entries);
      const Vec3Lanes r = i.xyz - j.xyz;
      eta -= j.w * VW.slope_in_units(dot(r, r)) * r;
    });
    eta = Lanes(VW.slope_unit) * eta;
    const Vec3Lanes omega_i = load_records(omega + slice.first).xyz;
    const Lanes length = sqrt(dot(eta, eta));
    // No direction out of rounding errors.
    const Mask has_direction = length * Lanes(VW.h) > Lanes(1e-4F) * i.w;
    const Lanes scale = select(has_direction, Lanes(impulse) / length, Lanes(0));
    const RecordLanes v_i = load_records(v + slice.first);
    store_records(v + slice.first, v_i.xyz + scale * cross(eta, omega_i), v_i.w);
  });
}

}  // namespace pbf::PBF_ISA_NAMESPACE
