#pragma once

#include "pbf/gl/buffer.hpp"
#include "pbf/gl/program.hpp"
#include "pbf/render/passes/environment.hpp"
#include "pbf/render/target.hpp"

#include <memory>

namespace pbf {

/// The picture without fluid and meshes: sky, floor and the shadow on it.
///
/// What does not move is kept: as long as camera, parameters and size stay, as they do in a video,
/// the next picture begins with a copy, and only the squares in which a shadow can lie are drawn.
class Backdrop {
 public:
  explicit Backdrop(const GlslSource& source);
  /// Replaces the content of `out`, srgb8, multiplied by alpha. The shadow must be bound, and the
  /// map.
  void operator()(const Surroundings& surroundings,
                  const Camera& camera,
                  const RenderParams& params,
                  const Framebuffer& out);
  /// To be called when the environment map becomes another.
  void forget() { kept_.reset(); }

 private:
  /// Draws the squares of the picture in which a shadow can lie, or all of them without shadow.
  void draw(bool in_shadow,
            const Surroundings& surroundings,
            const Camera& camera,
            const RenderParams& params,
            const Framebuffer& out);
  struct Kept {
    Camera camera;
    RenderParams params;
    Target picture;  ///< without any shadow
  };
  ProgramVariants program_;
  Buffer squares_;
  VertexArray squares_array_;
  std::unique_ptr<Kept> kept_;
};

}  // namespace pbf
