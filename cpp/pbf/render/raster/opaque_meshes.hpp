#pragma once

#include "pbf/render/camera.hpp"
#include "pbf/render/environment.hpp"
#include "pbf/render/frame_block.hpp"
#include "pbf/render/mesh.hpp"
#include "pbf/render/raster/map.hpp"

namespace pbf::raster {

/// The pass of the same name in C++: depth and light of the nearest triangle at each pixel, whose
/// middle counts. On a triangle affine depth is an affine function of the pixel, so it is exact.
class OpaqueMeshes {
 public:
  OpaqueMeshes(int width, int height);
  void draw(const Meshes& meshes,
            const Camera& camera,
            const FrameBlock& frame,
            const Environment& environment,
            int threads);

  [[nodiscard]] const Tiles& tiles() const { return tiles_; }  ///< where there may be meshes
  [[nodiscard]] const Map& depth() const { return depth_; }    ///< affine
  [[nodiscard]] const Map& red() const { return red_; }        ///< linear light
  [[nodiscard]] const Map& green() const { return green_; }
  [[nodiscard]] const Map& blue() const { return blue_; }

 private:
  Tiles tiles_;
  Map depth_, red_, green_, blue_;
};

}  // namespace pbf::raster
