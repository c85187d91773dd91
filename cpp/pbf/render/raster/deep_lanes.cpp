// Compiled once per instruction set (cpp/pbf_render.cmake).
#include "pbf/render/raster/deep_kernels.hpp"
#include "pbf/render/raster/frame_lanes.hpp"

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

/// Cells along a side of the picture, with the margin.
PBF_INLINE Ints cells_along(float pixels, Ints level) {
  return ((static_cast<int>(pixels) + (1 << level) - 1) >> level) + 2 * DeepKernels::kMargin;
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
    const Ints width = cells_along(view.width, level), height = cells_along(view.height, level);
    const Mask inside = (Lanes(0.0F) <= x) & (Lanes(0.0F) <= y) & (x < to_lanes(width - 1)) &
                        (y < to_lanes(height - 1)) & (depth < Lanes(view.far)) & Mask{is_deep};
    const Lanes column = floor(select(inside, x, 0.0F)), line = floor(select(inside, y, 0.0F));
    // Along the ray: a cell's area across it is smaller than in the picture's plane.
    const Lanes slant = view.perspective ? sqrt(dot(center, center)) / depth : Lanes(1.0F);
    const Lanes cells_per_meter = pixels_per_meter * per_pixel;
    const Lanes amount = view.volume * slant * cells_per_meter * cells_per_meter;
    const Ints cell = to_ints(line) * width + to_ints(column);
    std::memcpy(shares.grid + i, &level, sizeof level);
    std::memcpy(shares.cell + i, &cell, sizeof cell);
    store(shares.right + i, x - column);
    store(shares.up + i, y - line);
    store(shares.amount + i, select(inside, amount, 0.0F));
  }
}

}  // namespace

const raster::DeepKernels& deep_kernels() {
  static constexpr DeepKernels table{share};
  return table;
}

}  // namespace pbf::PBF_ISA_NAMESPACE
