#include "pbf/render/cpu_renderer.hpp"

#include "pbf/core/stopwatch.hpp"
#include "pbf/render/checks.hpp"
#include "pbf/render/legend.hpp"
#include "pbf/render/raster/backdrop.hpp"
#include "pbf/render/raster/composite.hpp"
#include "pbf/render/raster/layers.hpp"
#include "pbf/render/raster/resolve.hpp"
#include "pbf/render/raster/surface_maps.hpp"
#include "pbf/render/raster/terms.hpp"

namespace pbf {
namespace {

constexpr int kThreads = 0;  // all there are

void require_drawable(int width, int height, int factor) {
  const int most = CpuRenderer::kMostPixels / factor;
  for (const auto& [side, name] : {std::pair{width, "width"}, std::pair{height, "height"}}) {
    if (checked_side(side, name) <= most) continue;
    throw InvalidParameter(std::string(name) + " = " + std::to_string(side) +
                           " pixels: must be at most " + std::to_string(most) +
                           (factor > 1 ? " with supersampling = " + std::to_string(factor) : ""));
  }
}

}  // namespace

struct CpuRenderer::Maps {
  Maps(int w, int h) : width(w), height(h), surface(w, h) {}
  int width, height;
  raster::SurfaceMaps surface;
  raster::ColoredSplats colored;
  // Made by the first picture that needs them.
  std::unique_ptr<raster::SphereMaps> spheres;
  std::unique_ptr<raster::TintMaps> tint;
  std::unique_ptr<raster::OpaqueMeshes> meshes;
  std::vector<std::uint32_t> larger;  ///< the picture before it is resolved
};

struct CpuRenderer::Kept {
  raster::Backdrop backdrop;
  std::unique_ptr<raster::Panorama> environment_map;
};

CpuRenderer::CpuRenderer(int width, int height)
    : width_(width), height_(height), kept_(std::make_unique<Kept>()) {
  prepare(1);
}

CpuRenderer::~CpuRenderer() = default;

CpuRenderer::Maps& CpuRenderer::prepare(int factor) {
  if (maps_ == nullptr || maps_->width != factor * width_) {
    require_drawable(width_, height_, factor);
    maps_ = std::make_unique<Maps>(factor * width_, factor * height_);
  }
  return *maps_;
}

template <class F>
void CpuRenderer::stage(const char* name, F&& pass) {
  double milliseconds = 0;
  {
    const Stopwatch stopwatch(milliseconds);
    pass();
  }
  if (timed_) report_.milliseconds.emplace_back(name, milliseconds);
}

void CpuRenderer::draw_spheres(const PointsView& positions,
                               const FrameBlock& frame,
                               const RenderParams& params,
                               const Colors& colors) {
  Maps& maps = *maps_;
  if (maps.spheres == nullptr) {
    maps.spheres = std::make_unique<raster::SphereMaps>(maps.width, maps.height);
  }
  const Colors all_alike(colors.empty() ? static_cast<std::size_t>(positions.cols()) : 0,
                         encoded_color(params.sphere_color));
  stage("spheres", [&] {
    maps.colored.spheres(positions, colors.empty() ? all_alike : colors,
                         params.sphere_radius_in_force(), frame, *maps.spheres, kThreads);
  });
}

void CpuRenderer::draw_fluid(const PointsView& positions,
                             const Camera& camera,
                             const FrameBlock& frame,
                             const RenderParams& params,
                             const Colors& colors) {
  Maps& maps = *maps_;
  maps.surface.find(positions, camera, params, raster::SurfaceMaps::For::picture);
  if (timed_) report_.milliseconds = maps.surface.milliseconds();
  if (colors.empty()) return;
  if (maps.tint == nullptr) maps.tint = std::make_unique<raster::TintMaps>(maps.width, maps.height);
  stage("tint", [&] {
    maps.colored.tint(positions, colors, params.radius, frame, maps.surface.depth_smooth(),
                      *maps.tint, kThreads);
  });
}

Image CpuRenderer::render(const PointsView& positions,
                          const Camera& camera,
                          const RenderParams& params,
                          const Meshes& meshes,
                          const ScalarsView& values) {
  require_sound(positions, camera, params, values, kept_->environment_map != nullptr);
  const ColorRange range = params.color_range.value_or(range_of(values));
  const Colors colors = colors_of(values, params.colormap, range);
  const int factor = params.supersampling;
  Maps& maps = prepare(factor);
  const FrameBlock frame = frame_block(camera, maps.width, maps.height);
  const bool spheres = params.style == Style::spheres;
  const bool tinted = !spheres && !colors.empty();
  report_ = {.particles = positions.cols(), .milliseconds = {}};
  if (spheres) {
    draw_spheres(positions, frame, params, colors);
  } else {
    draw_fluid(positions, camera, frame, params, colors);
  }
  SunShadow shadow;
  stage("shadow", [&] { shadow = sun_shadow(positions, shadow_params(params, tinted), meshes); });
  const raster::Scene scene =
      raster::scene_of(frame, environment_of(params, camera), shadow, kept_->environment_map.get());
  if (!meshes.empty()) {
    if (maps.meshes == nullptr) {
      maps.meshes = std::make_unique<raster::OpaqueMeshes>(maps.width, maps.height);
    }
    stage("opaque_meshes",
          [&] { maps.meshes->draw(meshes, camera, frame, scene.environment, kThreads); });
  }
  Image image{width_, height_, 4, {}};
  image.data.resize(static_cast<std::size_t>(4) * width_ * height_);
  const raster::Picture finished = raster::picture_of(image);
  const bool resolves = factor > 1 || params.background == Background::transparent;
  maps.larger.resize(resolves ? static_cast<std::size_t>(maps.width) * maps.height : 0);
  raster::Picture picture = finished;
  if (resolves) {
    picture = {maps.larger.data(), maps.width, maps.width, maps.height, finished.light};
  }
  stage("backdrop", [&] {
    const Rectangle reach =
        shadow_rectangle(shadow, camera, scene.environment, maps.width, maps.height);
    kept_->backdrop(scene, camera, params, reach, picture, kThreads);
  });
  stage("composite", [&] {
    const raster::Composite composite(scene, params, meshes.empty() ? nullptr : maps.meshes.get(),
                                      picture, kThreads);
    composite.draw_meshes();
    if (spheres) {
      composite.draw(*maps.spheres, maps.colored.tiles());
    } else {
      const raster::SurfaceMaps& found = maps.surface;
      composite.draw({found.tiles(), found.depth_smooth(), found.thickness_smooth(),
                      found.back_smooth(), found.depth(), found.normal(),
                      tinted ? maps.tint.get() : nullptr});
    }
  });
  if (resolves) stage("resolve", [&] { raster::resolve(picture, factor, finished, kThreads); });
  if (values.size() > 0 && !params.legend.empty()) {
    draw_legend(image, params.legend, params.colormap, range);
  }
  return image;
}

void CpuRenderer::set_environment_map(const std::optional<EnvironmentMap>& map) {
  if (map) validate(*map);
  kept_->backdrop.forget();
  kept_->environment_map = map ? std::make_unique<raster::Panorama>(*map) : nullptr;
}

Layers CpuRenderer::layers(const PointsView& positions,
                           const Camera& camera,
                           const RenderParams& params) {
  require_sound(positions, camera, params);
  Maps& maps = prepare(1);
  report_ = {.particles = positions.cols(), .milliseconds = {}};
  if (params.style == Style::spheres) {
    draw_spheres(positions, frame_block(camera, maps.width, maps.height), params, {});
    Layers layers;
    layers.depth = raster::depth_pixels(maps.spheres->depth, camera);
    layers.normal = raster::pixels(maps.spheres->normal);
    return layers;
  }
  maps.surface.find(positions, camera, params, raster::SurfaceMaps::For::layers);
  if (timed_) report_.milliseconds = maps.surface.milliseconds();
  return {.depth = raster::depth_pixels(maps.surface.depth(), camera),
          .depth_smooth = raster::depth_pixels(maps.surface.depth_smooth(), camera),
          .thickness = raster::pixels(maps.surface.thickness()),
          .thickness_smooth = raster::pixels(maps.surface.thickness_smooth()),
          .normal = raster::pixels(maps.surface.normal())};
}

}  // namespace pbf
