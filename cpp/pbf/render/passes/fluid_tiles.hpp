#pragma once

#include "pbf/gl/buffer.hpp"
#include "pbf/render/camera.hpp"

#include <vector>

namespace pbf {

/// The squares of the picture in which there may be fluid. Passes over the picture draw only these:
/// a software rasterizer works off every branch of a shader at every pixel, so skipping has to
/// happen before.
class FluidTiles {
 public:
  static constexpr int kSide = 32;  ///< [pixels]

  FluidTiles(int width, int height);
  /// Finds the squares that spheres of a radius [m] can reach.
  void find(const PointsView& positions, const Camera& camera, Real radius);
  /// Depth of the nearest sphere's front that may be seen, at least the near plane's [m].
  [[nodiscard]] Real nearest() const { return nearest_; }
  /// Replaces what is in these squares of the target; for programs with glsl/fluid_tiles.vert.
  void draw() const;

 private:
  void mark(int x0, int x1, int y0, int y1);
  int width_, height_, columns_, rows_;
  Buffer buffer_;
  VertexArray array_;
  std::vector<char> reached_;
  GLsizei count_ = 0;
  Real nearest_ = 0;
};

}  // namespace pbf
