// Compiled once per instruction set (cpp/pbf_render.cmake).
#include "pbf/render/nearest_kernels.hpp"
#include "pbf/render/raster/glsl_lanes.hpp"

namespace pbf::PBF_ISA_NAMESPACE {
namespace {

float nearest(const float* xyz,
              Index count,
              float radius,
              const float (&beyond)[2],
              const raster::FrameTerms& frame) {
  const float* m = frame.view;
  constexpr float kNone = 3e38F;
  Lanes least = kNone;
  for (Index i = 0; i < count; i += kLanes) {
    const Vec3Lanes p = load_points(xyz + 3 * i);
    const auto row = [&](int k) PBF_LAMBDA_INLINE {
      return m[k] * p.x + m[4 + k] * p.y + m[8 + k] * p.z + m[12 + k];
    };
    const Lanes depth = -row(2);
    const Lanes spread = frame.perspective ? depth : Lanes(1.0F);
    const Mask is_particle{lane_numbers() < (static_cast<int>(count - i) - Ints{})};
    const Mask seen = (depth + radius > Lanes(frame.near)) & (depth - radius < Lanes(frame.far)) &
                      (abs(row(0)) < frame.half_width * spread + beyond[0]) &
                      (abs(row(1)) < frame.half_height * spread + beyond[1]);
    least = min(select(seen & is_particle, max(depth - radius, frame.near), kNone), least);
  }
  float result = kNone;
  for (int lane = 0; lane < kLanes; ++lane) {
    result = least.v[lane] < result ? least.v[lane] : result;
  }
  return result;
}

}  // namespace

const NearestKernels& nearest_kernels() {
  static constexpr NearestKernels table{nearest};
  return table;
}

}  // namespace pbf::PBF_ISA_NAMESPACE
