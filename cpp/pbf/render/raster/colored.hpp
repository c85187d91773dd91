#pragma once

#include "pbf/render/colormap.hpp"
#include "pbf/render/raster/normal.hpp"
#include "pbf/render/raster/splats.hpp"

namespace pbf::raster {

/// What the pass spheres finds.
struct SphereMaps {
  SphereMaps(int width, int height)
      : depth(width, height, kNothing), normal(width, height), color(width, height, 0) {}
  Map depth;  ///< affine
  NormalMaps normal;
  Map color;  ///< packed (glsl/color.glsl)
};

/// What the pass tint finds, with half as many pixels to a side as the picture.
struct TintMaps {
  TintMaps(int width, int height)
      : red((width + 1) / 2, (height + 1) / 2, 0),
        green(red.width(), red.height(), 0),
        blue(red.width(), red.height(), 0),
        weight(red.width(), red.height(), 0) {}
  Map red, green, blue;  ///< weight times light
  Map weight;
};

/// Particles with colors: the passes spheres and tint in C++.
class ColoredSplats {
 public:
  /// @param radius  of a sphere [m]   @param threads  0: all there are
  void spheres(const PointsView& positions,
               const Colors& colors,
               Real radius,
               const FrameBlock& frame,
               SphereMaps& out,
               int threads);
  /// @param surface  affine depth
  void tint(const PointsView& positions,
            const Colors& colors,
            Real radius,
            const FrameBlock& frame,
            const Map& surface,
            TintMaps& out,
            int threads);
  /// Those that spheres cover.
  [[nodiscard]] const Tiles& tiles() const { return splats_.tiles(); }

 private:
  void bin(const PointsView& positions, const Colors& colors, const SplatView& view, int threads);
  Records particles_;
  Splats splats_;
};

}  // namespace pbf::raster
