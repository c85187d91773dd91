#pragma once

namespace pbf::bench {

/// What this machine can do at best with a number of threads and chosen_isa(): the roofs of the
/// roofline model [WWP09], each the best of many short runs.
struct Roof {
  double fused_flops;      ///< multiply-adds, fused where the instruction set can         [flop/s]
  double separate_flops;   ///< multiplications and additions that are not fused           [flop/s]
  double bandwidth;        ///< of memory, beyond the last cache                              [B/s]
  double last_cache;       ///< what fits need not come from memory                             [B]
  double record_loads;     ///< of 16 bytes at random places in the first cache         [records/s]
  double record_loads_l2;  ///< … in the second                                         [records/s]
  double record_gathers;   ///< record_loads by gather instructions, 0 without them     [records/s]
};

/// Measured at the first call for this number of threads, in about a second.
const Roof& roof_of(int threads);

}  // namespace pbf::bench
