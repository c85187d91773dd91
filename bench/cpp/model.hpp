#pragma once

#include "pbf/fluid/step_report.hpp"

#include "roof.hpp"
#include <algorithm>

/// The least work of a stage, fixed so that it means the same for every version of the code: it
/// follows from the formulas, and what a version does beyond it counts for nothing. Set against the
/// roofs it gives the least time that this machine could need.
///
/// Flops per pair of neighbors (i, j), in which +, −, ×, √ and 1/√ with its Newton step count 1, 1,
/// 1, 1 and 5; pairs are counted from both sides, those with boundary particles not at all:
///   r = x_i − x_j, ‖r‖²                       3 + 5
///   1/‖r‖, ‖r‖                                5 + 1
///   W, ∇W/r                                   3, 3
///   Σ of a scalar, of a vector times scalar   1, 6
/// Bytes per particle are those that a pass cannot do without, float32, each array once, since
/// neighbors in cell order come from the caches; what is written counts twice, as the cache line is
/// read first.
namespace pbf::bench {

struct Model {
  double flops = 0;    ///< per pair
  double records = 0;  ///< loaded per pair: (x, y, z, and a scalar) of a neighbor
  double bytes = 0;    ///< per particle, without the lists
  double lists = 0;    ///< how often the lists are read or written
};

constexpr Model model_of(Stage stage) {
  switch (stage) {
    // 8 for each distance tested, two tests to a neighbor: with cells of h/3 in the rest lattice no
    // more are needed. Reads x*, brings x, v and x* into a new order, writes the lists.
    case Stage::neighbors:
      return {.flops = 16, .records = 0, .bytes = 120, .lists = 2};
    // 14 + W + ΣW + ∇W/r + Σ∇W + Σ‖∇W‖². Reads x*, writes λ.
    case Stage::multipliers:
      return {.flops = 29, .records = 1, .bytes = 20, .lists = 1};
    // 14 + ∇W/r + λ_i + λ_j, its product with that, Σ of vectors; s_corr 7. Reads x*, λ, writes x*.
    case Stage::corrections:
      return {.flops = 25 + 7, .records = 1, .bytes = 40, .lists = 1};
    // ω: 14 + ∇W/r, v_j − v_i 3, × r 9, Σ 6. Reads x, v, writes ω and ‖ω‖.
    // η: 14 + ∇W/r, ‖ω_j‖ 1, Σ 6. Reads x and ‖ω‖, ω, v, writes v in the lines it has read.
    case Stage::vorticity:
      return {.flops = 35 + 24, .records = 2 + 1, .bytes = 56 + 52, .lists = 2};
    // 8 + W + ΣW, v_j − v_i 3, Σ 6. Reads x, v, writes v and ρ.
    case Stage::xsph:
      return {.flops = 21, .records = 2, .bytes = 48, .lists = 1};
    // 8 + W + ΣW. Reads x, writes ρ.
    case Stage::density:
      return {.flops = 12, .records = 1, .bytes = 20, .lists = 1};
    default:
      return {};
  }
}

/// The seconds that one pass of a stage needs under each roof alone.
struct Floor {
  double flops = 0;
  double bandwidth = 0;
  double records = 0;

  /// Under all of them: the least that a pass can take.
  [[nodiscard]] double seconds() const { return std::max({flops, bandwidth, records}); }
  /// The roof that binds.
  [[nodiscard]] const char* roof() const {
    if (seconds() == records) return "record loads";
    return seconds() == flops ? "flops" : "bandwidth";
  }
};

inline Floor floor_of(
    Stage stage, double particles, double pairs, double list_bytes, const Roof& roof) {
  const Model model = model_of(stage);
  const double bytes = model.bytes * particles + model.lists * list_bytes;
  return {.flops = model.flops * pairs / roof.fused_flops,
          .bandwidth = bytes > roof.last_cache ? bytes / roof.bandwidth : 0,
          .records = model.records * pairs / roof.record_loads};
}

}  // namespace pbf::bench
