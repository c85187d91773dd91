#pragma once

#include "pbf/render/camera.hpp"
#include "pbf/render/params.hpp"
#include "pbf/render/raster/picture.hpp"
#include "pbf/render/raster/scene.hpp"
#include "pbf/render/shadow_rectangle.hpp"

#include <memory>
#include <vector>

namespace pbf::raster {

/// The pass of the same name in C++: the picture without fluid and meshes, of which is kept what
/// does not move.
class Backdrop {
 public:
  /// Replaces the content of `out`.
  /// @param in_shadow  the pixels in which the scene's shadow can lie
  void operator()(const Scene& scene,
                  const Camera& camera,
                  const RenderParams& params,
                  const Rectangle& in_shadow,
                  const Picture& out,
                  int threads);
  /// To be called when the environment map becomes another.
  void forget() { kept_.reset(); }

 private:
  struct Kept {
    Camera camera;
    RenderParams params;
    int width, height;
    std::vector<std::uint32_t> pixels;  ///< without any shadow
  };
  std::unique_ptr<Kept> kept_;
};

}  // namespace pbf::raster
