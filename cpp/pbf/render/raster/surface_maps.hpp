#pragma once

#include "pbf/render/anisotropy.hpp"
#include "pbf/render/camera.hpp"
#include "pbf/render/crowding.hpp"
#include "pbf/render/layer_filter.hpp"
#include "pbf/render/params.hpp"
#include "pbf/render/raster/deep_thickness.hpp"
#include "pbf/render/raster/normal.hpp"
#include "pbf/render/raster/splats.hpp"

#include <string>
#include <utility>
#include <vector>

namespace pbf::raster {

/// The passes from particles to a smooth surface with its normals, in C++.
class SurfaceMaps {
 public:
  SurfaceMaps(int width, int height);
  /// What the maps are for: a picture needs the far side too, and thickness of what lies deep in a
  /// body with half as many pixels to a side, which it does not show.
  enum class For { picture, layers };
  /// @param positions  finite [m]
  /// @param threads    0: all there are; the maps have the same bits with any
  void find(const PointsView& positions,
            const Camera& camera,
            const RenderParams& params,
            For purpose,
            int threads = 0);

  /// Where the maps below can hold fluid.
  [[nodiscard]] const Tiles& tiles() const { return splats_.tiles(); }
  [[nodiscard]] const Map& depth() const { return depth_; }          ///< affine, with crowding
  [[nodiscard]] const Map& thickness() const { return thickness_; }  ///< [m]
  [[nodiscard]] const Map& depth_smooth() const { return *smooth_depth_; }  ///< affine
  [[nodiscard]] const Map& back_smooth() const { return back_out_; }  ///< affine, of a picture
  [[nodiscard]] const Map& thickness_smooth() const { return *smooth_thickness_; }  ///< [m]
  [[nodiscard]] const NormalMaps& normal() const { return normal_; }

  /// Each pass in order and the time it took [ms].
  [[nodiscard]] const auto& milliseconds() const { return milliseconds_; }

 private:
  template <class F>
  void stage(const char* name, F&& pass);
  /// The iterations of a separable filter, and a last one if it leaves gaps.
  const Map* smoothed(const LayerFilter& filter,
                      int iterations,
                      const FrameBlock& frame,
                      Real nearest,
                      const Map& values,
                      Map& between,
                      Map& out,
                      int threads);

  Neighborhoods particles_;
  Crowding crowding_;
  Anisotropy anisotropy_;
  Splats splats_;
  DeepThickness deep_thickness_;
  Map depth_, thickness_;
  Map depth_between_, thickness_between_;
  Map depth_out_, thickness_out_;
  Map depth_third_;  // of curvature flow
  Map back_, back_out_;
  NormalMaps normal_;
  const Map* smooth_depth_ = &depth_;
  const Map* smooth_thickness_ = &thickness_;
  std::vector<std::pair<std::string, double>> milliseconds_;
};

}  // namespace pbf::raster
