#pragma once

#include "pbf/core/lanes.hpp"
#include "pbf/fluid/sweeps.hpp"

namespace pbf::PBF_ISA_NAMESPACE {

/// What is near the particles of a slice.
struct Slice {
  Index first;  ///< its particles are first … first + kLanes − 1
  const std::uint32_t *neighbors, *neighbors_end;
  const Real *walls, *walls_end;

  /// f(entries): the k-th neighbors of all lanes, for gather().
  template <class F>
  PBF_INLINE void for_each_neighbor(F&& f) const {
    for (const std::uint32_t* slot = neighbors; slot != neighbors_end; slot += kLanes) f(slot);
  }
  /// f(q): the k-th boundary particles of all lanes.
  template <class F>
  PBF_INLINE void for_each_wall(F&& f) const {
    for (const Real* q = walls; q != walls_end; q += 3 * kLanes) {
      f(Vec3Lanes{load_lanes(q), load_lanes(q + kLanes), load_lanes(q + 2 * kLanes)});
    }
  }
};

template <class F>
PBF_INLINE void for_each_slice(const Stretch& at, F&& f) {
  std::uint32_t neighbors = 0, walls = 0;  // slots so far
  const std::uint32_t *neighbor_end = at.neighbors.ends, *wall_end = at.walls.ends;
  for (Index i = at.first; i < at.last; i += kLanes, ++neighbor_end, ++wall_end) {
    f(Slice{i, at.neighbors.entries + neighbors * Index{kLanes},
            at.neighbors.entries + *neighbor_end * Index{kLanes},
            at.walls.entries + walls * Index{3 * kLanes},
            at.walls.entries + *wall_end * Index{3 * kLanes}});
    neighbors = *neighbor_end;
    walls = *wall_end;
  }
}

}  // namespace pbf::PBF_ISA_NAMESPACE
