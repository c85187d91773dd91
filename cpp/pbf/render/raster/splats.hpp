#pragma once

#include "pbf/core/records.hpp"
#include "pbf/render/frame_block.hpp"
#include "pbf/render/raster/map.hpp"
#include "pbf/render/raster/splat_kernels.hpp"

#include <functional>
#include <vector>

namespace pbf::raster {

/// The passes sphere_depth and thickness in C++: sprites are sorted into the tiles that they cover,
/// in the order of the particles, and a thread draws one tile after the other. So the same bits for
/// any number of threads.
class Splats {
 public:
  /// Sorts the particles, with their crowding, into tiles.
  /// @param particles  behind the last there must be kMostLanes that can be read
  /// @param stretches  of ellipsoids (Anisotropy), two for each; null: spheres
  void bin(const Record* particles,
           Index n,
           const SplatView& view,
           int threads,
           const Record* stretches = nullptr);
  /// @param depth      affine depth with its crowding, as glsl/sphere_depth.frag writes it
  /// @param thickness  [m]
  /// @param back       affine depth of the farthest far side
  void draw(const SplatView& view, Map& depth, Map& thickness, Map& back, int threads) const;
  using TileLoop = void(Tile tile, const Record* centers, const Record* stretches, Index count);
  /// Calls f for each tile that sprites cover, several at once: centers in eye space, with the
  /// fourth number that they came with.
  void for_tiles(int threads, const std::function<TileLoop>& f) const;
  /// Those that sprites cover.
  [[nodiscard]] const Tiles& tiles() const { return tiles_; }

 private:
  /// Sprites side by side.
  struct Sprites {
    Records centers;
    Records stretches;  // two for each, or none: spheres
    void resize(Index n, bool stretched);
    void set(Index at, const Sprites& from, Index i);
    [[nodiscard]] const Record* stretches_from(Index at) const {
      return stretches.size() > 0 ? stretches.data() + 2 * at : nullptr;
    }
  };
  void find_large();
  /// These of binned_ behind the large ones.
  [[nodiscard]] Sprites with_large(Index first, Index count) const;

  Tiles tiles_{1, 1};
  Sprites all_, binned_;
  std::vector<TileBox> boxes_;
  std::vector<std::uint32_t> places_;  // of each tile in each block of particles
  std::vector<std::uint32_t> starts_;  // in binned_, of each tile and the end
  std::vector<Index> large_;           // of all_, drawn in every tile
};

SplatView splat_view(const FrameBlock& frame, const RenderParams& params);

/// Marks the tiles that spheres of a radius [m] can reach.
void mark_tiles(const PointsView& positions, Real radius, const FrameBlock& frame, Tiles& tiles);
/// The same of the ellipsoids that stretches (Anisotropy) make of them.
void mark_tiles(
    const Records& centers, Records stretches, Real radius, const FrameBlock& frame, Tiles& tiles);

}  // namespace pbf::raster
