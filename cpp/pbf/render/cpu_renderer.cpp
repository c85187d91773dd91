#include "pbf/render/cpu_renderer.hpp"

#include "pbf/core/stopwatch.hpp"
#include "pbf/render/checks.hpp"
#include "pbf/render/raster/normal.hpp"

namespace pbf {
namespace {

int side(int pixels, const char* name) {
  if (checked_side(pixels, name) > CpuRenderer::kMostPixels) {
    throw InvalidParameter(std::string(name) + " = " + std::to_string(pixels) +
                           " pixels: must be at most " + std::to_string(CpuRenderer::kMostPixels));
  }
  return pixels;
}

}  // namespace

CpuRenderer::CpuRenderer(int width, int height)
    : maps_(side(width, "width"), side(height, "height")) {}

Layers CpuRenderer::layers(const PointsView& positions,
                           const Camera& camera,
                           const RenderParams& params) {
  validate(camera);
  validate(params);
  require_finite(positions);
  maps_.find(positions, camera, params, true);
  report_ = {.particles = positions.cols(), .milliseconds = {}};
  if (timed_) report_.milliseconds = maps_.milliseconds();
  Layers layers{.depth = raster::depth_pixels(maps_.depth(), camera),
                .depth_smooth = raster::depth_pixels(maps_.depth_smooth(), camera),
                .thickness = raster::pixels(maps_.thickness()),
                .thickness_smooth = raster::pixels(maps_.thickness_smooth()),
                .normal = {}};
  double milliseconds = 0;
  {
    const Stopwatch stopwatch(milliseconds);
    layers.normal =
        raster::normal(maps_.depth_smooth(), maps_.depth(), maps_.tiles(), camera, params, 0);
  }
  if (timed_) report_.milliseconds.emplace_back("normal", milliseconds);
  return layers;
}

}  // namespace pbf
