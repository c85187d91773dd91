#pragma once

#include "pbf/render/anisotropy.hpp"
#include "pbf/render/camera.hpp"
#include "pbf/render/crowding.hpp"
#include "pbf/render/layer_filter.hpp"
#include "pbf/render/params.hpp"
#include "pbf/render/raster/map.hpp"
#include "pbf/render/raster/splats.hpp"

#include <string>
#include <utility>
#include <vector>

namespace pbf::raster {

/// The passes from particles to a smooth surface in C++, without OpenGL: what those in glsl/ do,
/// for drivers that run shaders on the processor and for machines that have no driver.
class SurfaceMaps {
 public:
  SurfaceMaps(int width, int height);
  /// @param positions  finite [m]
  /// @param exact      if not, what lies deep in a body adds to the thickness with half as many
  ///                   pixels to a side, which no picture shows
  /// @param threads    0: all there are; the maps have the same bits with any
  void find(const PointsView& positions,
            const Camera& camera,
            const RenderParams& params,
            bool exact,
            int threads = 0);

  /// Where the maps below can hold fluid.
  [[nodiscard]] const Tiles& tiles() const { return splats_.tiles(); }
  [[nodiscard]] const Map& depth() const { return depth_; }          ///< affine, with crowding
  [[nodiscard]] const Map& thickness() const { return thickness_; }  ///< [m]
  [[nodiscard]] const Map& depth_smooth() const { return *smooth_depth_; }  ///< affine
  [[nodiscard]] const Map& back_smooth() const { return back_out_; }        ///< affine, far side
  [[nodiscard]] const Map& thickness_smooth() const { return *smooth_thickness_; }  ///< [m]

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
  Splats splats_, deep_splats_;
  Map depth_, thickness_;
  Map deep_thickness_;  // with half as many pixels to a side
  Map depth_between_, thickness_between_;
  Map depth_out_, thickness_out_;
  Map depth_third_;  // of curvature flow
  Map back_, back_out_;
  const Map* smooth_depth_ = &depth_;
  const Map* smooth_thickness_ = &thickness_;
  std::vector<std::pair<std::string, double>> milliseconds_;
};

}  // namespace pbf::raster
