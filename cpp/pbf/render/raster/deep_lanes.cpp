// Compiled once per instruction set (cpp/pbf_render.cmake).
#include "pbf/render/raster/deep_kernels.hpp"
#include "pbf/render/raster/frame_lanes.hpp"
#include "pbf/render/share_lanes.hpp"

namespace pbf::PBF_ISA_NAMESPACE {
namespace {

using namespace raster;

/// 0 or 1 each.
using Flags = std::uint8_t __attribute__((vector_size(kLanes)));

/// The next whole number of the logarithm to base 2, of a number > 0.
PBF_INLINE Ints ceil_log2(Lanes a) {
  return ((reinterpret_cast<Ints>(a.v) + 0x7FFFFF) >> 23) - 127;
}

/// 2^-k.
PBF_INLINE Lanes inverse_power(Ints k) {
  return {reinterpret_cast<Lanes::Vector>((127 - k) << 23)};
}

void share(const float* xyz,
           const std::uint8_t* flags,
           Index count,
           const SplatView& view,
           Shares& shares) {
  for (Index i = 0; i < count; i += kLanes) {
    const Ints is_deep = -__builtin_convertvector(load<Flags>(flags + i), Ints);
    if (!any({is_deep})) {
      store(shares.amount + i, 0.0F);
      continue;
    }
    const Vec3Lanes center = eye_space(view, load_points(xyz + 3 * i));
    const Lanes depth = -center.z;
    const Lanes pixels_per_meter =
        view.perspective ? view.pixels_per_meter / depth : Lanes(view.pixels_per_meter);
    // A cell is as wide as the sprite's radius or down to half of that.
    const Ints level =
        clamp(ceil_log2(0.5F * view.radius * pixels_per_meter), 1, DeepKernels::kLevels);
    const Lanes per_pixel = inverse_power(level);
    const PixelLanes pixel = pixel_of(view, center);
    const Lanes x = pixel.x * per_pixel + (DeepKernels::kMargin - 0.5F);
    const Lanes y = pixel.y * per_pixel + (DeepKernels::kMargin - 0.5F);
    const Ints width = DeepKernels::cells_along(static_cast<int>(view.width), level);
    const Ints height = DeepKernels::cells_along(static_cast<int>(view.height), level);
    const Mask inside = is_within(x, y, width, height) & (depth < Lanes(view.far)) & Mask{is_deep};
    // Along the ray: a cell's area across it is smaller than in the picture's plane.
    const Lanes slant = view.perspective ? sqrt(dot(center, center)) / depth : Lanes(1.0F);
    const Lanes cells_per_meter = pixels_per_meter * per_pixel;
    const Lanes amount = view.volume * slant * cells_per_meter * cells_per_meter;
    std::memcpy(shares.grid + i, &level, sizeof level);
    store_shares(shares, i, x, y, width, inside, amount);
  }
}

}  // namespace

const raster::DeepKernels& deep_kernels() {
  static constexpr DeepKernels table{share};
  return table;
}

}  // namespace pbf::PBF_ISA_NAMESPACE
