#pragma once

#include "pbf/gl/egl_context.hpp"
#include "pbf/render/camera.hpp"
#include "pbf/render/environment_map.hpp"
#include "pbf/render/image.hpp"
#include "pbf/render/mesh.hpp"
#include "pbf/render/params.hpp"
#include "pbf/render/report.hpp"

#include <memory>
#include <optional>
#include <string>

namespace pbf {

struct FrameBlock;
struct Surface;
class Texture;

/// Draws particles as a fluid with OpenGL: screen-space rendering in six passes [vdL09]. Where the
/// driver draws on the processor, CpuRenderer does the same several times faster.
///
/// Any thread may use it, one at a time; several renderers may live in one thread or in several. In
/// a process forked from the one that made it, every call throws GlError.
class FluidRenderer {
 public:
  /// @param device  which to draw on, as for device_wish(); empty leaves the choice open
  /// Throws InvalidParameter for a size the driver cannot draw, RendererUnavailable without OpenGL.
  FluidRenderer(int width, int height, const std::string& device = "");
  /// Draws with a context that is there already.
  FluidRenderer(int width, int height, std::unique_ptr<EglContext> context);
  ~FluidRenderer();
  FluidRenderer(const FluidRenderer&) = delete;
  FluidRenderer& operator=(const FluidRenderer&) = delete;

  /// @param positions  finite, column i is particle i [m]
  /// @param values  finite, a number per particle that becomes its color; none: none
  Image render(const PointsView& positions,
               const Camera& camera,
               const RenderParams& params,
               const Meshes& meshes = {},
               const ScalarsView& values = Scalars());
  /// What background and reflection "map" show; nothing takes it away again.
  void set_environment_map(const std::optional<EnvironmentMap>& map);
  /// For spheres thickness is left empty, as are the smoothed ones.
  Layers layers(const PointsView& positions, const Camera& camera, const RenderParams& params);

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] const EglContext& context() const { return *context_; }
  [[nodiscard]] const RenderReport& report() const { return report_; }
  /// Waiting for each pass costs time: only for whoever wants to know.
  void set_timed(bool timed) { timed_ = timed; }
  [[nodiscard]] bool timed() const { return timed_; }

 private:
  struct Passes;
  struct Targets;
  /// Makes targets of `factor` times the picture's size unless there are.
  void prepare_targets(int factor);
  Surface draw(const PointsView& positions,
               const Camera& camera,
               const RenderParams& params,
               const Colors& colors,
               bool with_back);
  Surface draw_fluid(const PointsView& positions,
                     const Camera& camera,
                     const FrameBlock& frame,
                     const RenderParams& params,
                     bool with_back);
  Surface draw_spheres(const PointsView& positions,
                       const Camera& camera,
                       const FrameBlock& frame,
                       const RenderParams& params,
                       const Colors& colors);
  const Texture& draw_tint(const PointsView& positions,
                           const Camera& camera,
                           const FrameBlock& frame,
                           const Texture& depth,
                           const RenderParams& params,
                           const Colors& colors);
  /// Runs a pass, and times it if that was asked for.
  template <class F>
  void stage(const char* name, F&& pass);

  int width_, height_;
  bool timed_ = false;
  std::unique_ptr<EglContext> context_;
  std::unique_ptr<Passes> passes_;
  std::unique_ptr<Targets> targets_;
  std::unique_ptr<Texture> environment_map_;
  RenderReport report_;
};

}  // namespace pbf
