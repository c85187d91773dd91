#include "pbf/render/nearest.hpp"

#include "pbf/core/parallel.hpp"
#include "pbf/render/nearest_kernels.hpp"
#include "pbf/render/point_block.hpp"
#include "pbf/render/raster/terms.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace pbf {
PBF_TABLE_BY_ISA(NearestKernels, nearest_kernels, nearest_kernels)

Real nearest_front(const PointsView& positions, Real radius, const FrameBlock& frame, int threads) {
  constexpr Index kBlock = 1 << 12;
  const raster::FrameTerms terms = raster::frame_terms(frame);
  // A sphere reaches over a side of the picture by its radius, measured across that side.
  const auto across = [&](Real half) { return terms.perspective ? std::hypot(1.0F, half) : 1; };
  const Real beyond[] = {radius * across(terms.half_width), radius * across(terms.half_height)};
  const NearestKernels& kernels = nearest_kernels(chosen_isa());
  const Index n = positions.cols();
  std::vector<Real> nearest(static_cast<std::size_t>((n + kBlock - 1) / kBlock));
  parallel_chunks(n, threads, kBlock, [&](Index first, Index last) {
    nearest[static_cast<std::size_t>(first / kBlock)] =
        kernels.nearest(point_block(positions, first, last), last - first, radius, beyond, terms);
  });
  return std::accumulate(nearest.begin(), nearest.end(), terms.far,
                         [](Real a, Real b) { return std::min(a, b); });
}

}  // namespace pbf
