// Compiled once per instruction set (cpp/pbf_render.cmake).
#include "pbf/core/lanes.hpp"
#include "pbf/render/full_cells_kernels.hpp"

namespace pbf::PBF_ISA_NAMESPACE {
namespace {

void locate(const Real* xyz, Index count, const CellBlock& block, std::uint32_t* cells) {
  for (Index i = 0; i < count; i += kLanes) {
    const Vec3Lanes p = load_points(xyz + 3 * i);
    Mask inside{~Ints{}};
    Ints cell{};
    const Lanes axes[] = {p.x, p.y, p.z};
    for (int axis = 0; axis < 3; ++axis) {
      const Lanes from_first = floor(axes[axis] * block.cells_per_meter) - block.first[axis];
      const Mask within = (Lanes(0.0F) <= from_first) & (from_first < Lanes(block.counts[axis]));
      inside = inside & within;
      const Lanes number = select(within, from_first, 0.0F);
      cell += __builtin_convertvector(number.v, Ints) * block.strides[axis];
    }
    cell &= inside.v;
    std::memcpy(cells + i, &cell, sizeof cell);
  }
}

}  // namespace

const FullCellsKernels& full_cells_kernels() {
  static constexpr FullCellsKernels table{locate};
  return table;
}

}  // namespace pbf::PBF_ISA_NAMESPACE
