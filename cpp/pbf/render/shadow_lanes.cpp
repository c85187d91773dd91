// Compiled once per instruction set (cpp/pbf_render.cmake).
#include "pbf/core/lanes.hpp"
#include "pbf/render/shadow_kernels.hpp"

namespace pbf::PBF_ISA_NAMESPACE {
namespace {

void share(const Real* xyz, Index count, const ShadowFrame& f, float amount, Shares& shares) {
  const Vec3Lanes center{f.center[0], f.center[1], f.center[2]};
  const Vec3Lanes to_u{f.u[0], f.u[1], f.u[2]}, to_v{f.v[0], f.v[1], f.v[2]};
  for (Index i = 0; i < count; i += kLanes) {
    const Vec3Lanes p = load_points(xyz + 3 * i) - center;
    const Lanes u = dot(to_u, p) + f.du, v = dot(to_v, p) + f.dv;
    const Mask inside = (Lanes(0.0F) <= u) & (Lanes(0.0F) <= v) &
                        (u < Lanes(static_cast<float>(f.width - 1))) &
                        (v < Lanes(static_cast<float>(f.height - 1)));
    const Lanes column = floor(select(inside, u, 0.0F)), row = floor(select(inside, v, 0.0F));
    const auto cell = __builtin_convertvector(row.v, Mask::Vector) * f.width +
                      __builtin_convertvector(column.v, Mask::Vector);
    std::memcpy(shares.cell + i, &cell, sizeof cell);
    store(shares.right + i, u - column);
    store(shares.up + i, v - row);
    store(shares.amount + i, select(inside, amount, 0.0F));
  }
  std::memset(shares.grid, 0, static_cast<std::size_t>(count) * sizeof *shares.grid);
}

}  // namespace

const ShadowKernels& shadow_kernels() {
  static constexpr ShadowKernels table{share};
  return table;
}

}  // namespace pbf::PBF_ISA_NAMESPACE
