// Compiled once per instruction set (cpp/pbf_render.cmake).
#include "pbf/render/shadow_kernels.hpp"
#include "pbf/render/share_lanes.hpp"

namespace pbf::PBF_ISA_NAMESPACE {
namespace {

void share(const Real* xyz, Index count, const ShadowFrame& f, float amount, Shares& shares) {
  const Vec3Lanes center{f.center[0], f.center[1], f.center[2]};
  const Vec3Lanes to_u{f.u[0], f.u[1], f.u[2]}, to_v{f.v[0], f.v[1], f.v[2]};
  const Ints width = f.width - Ints{}, height = f.height - Ints{};
  for (Index i = 0; i < count; i += kLanes) {
    const Vec3Lanes p = load_points(xyz + 3 * i) - center;
    const Lanes u = dot(to_u, p) + f.du, v = dot(to_v, p) + f.dv;
    store_shares(shares, i, u, v, width, is_within(u, v, width, height), amount);
  }
  std::memset(shares.grid, 0, static_cast<std::size_t>(count) * sizeof *shares.grid);
}

}  // namespace

const ShadowKernels& shadow_kernels() {
  static constexpr ShadowKernels table{share};
  return table;
}

}  // namespace pbf::PBF_ISA_NAMESPACE
