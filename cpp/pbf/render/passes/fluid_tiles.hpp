#pragma once

#include "pbf/core/records.hpp"
#include "pbf/gl/buffer.hpp"
#include "pbf/gl/draw.hpp"
#include "pbf/render/frame_block.hpp"
#include "pbf/render/raster/tiles.hpp"

namespace pbf {

/// The squares of the picture in which there may be fluid. Passes over the picture draw only these:
/// a software rasterizer works off every branch of a shader at every pixel, so skipping has to
/// happen before.
class FluidTiles {
 public:
  static constexpr int kSide = raster::kTileSide;  ///< [pixels]

  FluidTiles(int width, int height);
  /// Finds the squares that spheres of a radius [m] can reach.
  void find(const PointsView& positions, const FrameBlock& frame, Real radius);
  /// The same of the ellipsoids that stretches (Anisotropy) make of them.
  void find(const Records& centers, const Records& stretches, const FrameBlock& frame, Real radius);
  /// Takes over squares that were found.
  void upload(const raster::Tiles& tiles);
  /// Draws these squares of the target; for programs with glsl/fluid_tiles.vert.
  void draw(Blend blend = Blend::replace) const;

 private:
  Buffer buffer_;
  VertexArray array_;
  raster::Tiles reached_;
  GLsizei count_ = 0;
};

}  // namespace pbf
