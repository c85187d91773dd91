// Compiled once per instruction set (cpp/pbf_render.cmake).
#include "pbf/render/nearest_kernels.hpp"
#include "pbf/render/raster/frame_lanes.hpp"

namespace pbf::PBF_ISA_NAMESPACE {
namespace {

float nearest(const float* xyz,
              Index count,
              float radius,
              const float (&beyond)[2],
              const raster::FrameTerms& frame) {
  constexpr float kNone = 3e38F;
  Lanes least = kNone;
  for (Index i = 0; i < count; i += kLanes) {
    const Vec3Lanes center = eye_space(frame, load_points(xyz + 3 * i));
    const Lanes depth = -center.z;
    const Lanes spread = frame.perspective ? depth : Lanes(1.0F);
    const Mask seen = (depth + radius > Lanes(frame.near)) & (depth - radius < Lanes(frame.far)) &
                      (abs(center.x) < frame.half_width * spread + beyond[0]) &
                      (abs(center.y) < frame.half_height * spread + beyond[1]);
    least =
        min(select(seen & first_lanes(count - i), max(depth - radius, frame.near), kNone), least);
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
