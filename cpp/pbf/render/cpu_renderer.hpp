#pragma once

#include "pbf/render/image.hpp"
#include "pbf/render/raster/surface_maps.hpp"
#include "pbf/render/report.hpp"

namespace pbf {

/// What FluidRenderer makes its pictures from, on a machine without OpenGL: the same passes in C++,
/// with the same parameters. Not for several threads at once.
class CpuRenderer {
 public:
  /// Throws InvalidParameter for a side that is not between 1 and kMostPixels.
  CpuRenderer(int width, int height);
  static constexpr int kMostPixels = 16384;

  /// @param positions  finite, column i is particle i [m]
  Layers layers(const PointsView& positions, const Camera& camera, const RenderParams& params);

  [[nodiscard]] const RenderReport& report() const { return report_; }
  void set_timed(bool timed) { timed_ = timed; }

 private:
  raster::SurfaceMaps maps_;
  RenderReport report_;
  bool timed_ = false;
};

}  // namespace pbf
