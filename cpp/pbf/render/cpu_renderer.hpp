#pragma once

#include "pbf/render/camera.hpp"
#include "pbf/render/environment_map.hpp"
#include "pbf/render/image.hpp"
#include "pbf/render/mesh.hpp"
#include "pbf/render/params.hpp"
#include "pbf/render/report.hpp"

#include <memory>
#include <optional>

namespace pbf {

struct FrameBlock;

/// Draws particles as FluidRenderer does, without OpenGL: the same passes in C++ (raster/), with
/// the same parameters. One thread at a time may use it.
class CpuRenderer {
 public:
  /// Throws InvalidParameter for a side that is not between 1 and kMostPixels.
  CpuRenderer(int width, int height);
  ~CpuRenderer();
  static constexpr int kMostPixels = 16384;

  // As FluidRenderer's.
  Image render(const PointsView& positions,
               const Camera& camera,
               const RenderParams& params,
               const Meshes& meshes = {},
               const ScalarsView& values = Scalars());
  void set_environment_map(const std::optional<EnvironmentMap>& map);
  Layers layers(const PointsView& positions, const Camera& camera, const RenderParams& params);

  [[nodiscard]] const RenderReport& report() const { return report_; }
  void set_timed(bool timed) { timed_ = timed; }

 private:
  struct Maps;
  struct Kept;
  /// Makes maps of `factor` times the picture's size unless there are.
  Maps& prepare(int factor);
  /// Runs a pass, and times it if that was asked for.
  template <class F>
  void stage(const char* name, F&& pass);
  void draw_spheres(const PointsView& positions,
                    const FrameBlock& frame,
                    const RenderParams& params,
                    const Colors& colors);
  void draw_fluid(const PointsView& positions,
                  const Camera& camera,
                  const FrameBlock& frame,
                  const RenderParams& params,
                  const Colors& colors);

  int width_, height_;
  bool timed_ = false;
  std::unique_ptr<Maps> maps_;
  std::unique_ptr<Kept> kept_;  ///< whatever the size
  RenderReport report_;
};

}  // namespace pbf
