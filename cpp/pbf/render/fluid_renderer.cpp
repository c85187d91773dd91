#include "pbf/render/fluid_renderer.hpp"

#include "pbf/gl/error.hpp"
#include "pbf/render/anisotropy.hpp"
#include "pbf/render/checks.hpp"
#include "pbf/render/crowding.hpp"
#include "pbf/render/frame_block.hpp"
#include "pbf/render/glsl_source.hpp"
#include "pbf/render/legend.hpp"
#include "pbf/render/nearest.hpp"
#include "pbf/render/passes/back_depth.hpp"
#include "pbf/render/passes/composite.hpp"
#include "pbf/render/passes/curvature_flow.hpp"
#include "pbf/render/passes/normal.hpp"
#include "pbf/render/passes/resolve.hpp"
#include "pbf/render/passes/smooth.hpp"
#include "pbf/render/passes/sphere_depth.hpp"
#include "pbf/render/passes/spheres.hpp"
#include "pbf/render/passes/thickness.hpp"
#include "pbf/render/passes/tint.hpp"
#include "pbf/render/read_back.hpp"
#include "pbf/render/target.hpp"

#include <chrono>
#include <cmath>

namespace pbf {
namespace {

/// Pixels to a side of a texture.
int most_pixels() {
  GLint limit = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &limit);
  return limit;
}

void require_drawable(int width, int height, int factor) {
  const int limit = most_pixels() / factor;
  if (width > limit || height > limit) {
    throw InvalidParameter((width > limit ? "width = " + std::to_string(width)
                                          : "height = " + std::to_string(height)) +
                           " pixels: this driver draws at most " + std::to_string(limit) +
                           (factor > 1 ? " with supersampling = " + std::to_string(factor) : ""));
  }
}

std::unique_ptr<Texture> panorama(const EnvironmentMap& map) {
  validate(map);
  if (const int most = most_pixels(); map.width > most || map.height > most) {
    throw InvalidParameter("environment_map: shape (" + std::to_string(map.height) + ", " +
                           std::to_string(map.width) + ", 3): this driver takes at most " +
                           std::to_string(most) + " pixels to a side; make it smaller");
  }
  std::vector<float> texels;
  texels.reserve(map.data.size() / 3 * 4);
  for (int y = map.height - 1; y >= 0; --y) {
    for (int x = 0; x < map.width; ++x) {
      for (int c = 0; c < 3; ++c) texels.push_back(std::min(map.at(x, y)[c], kBrightest));
      texels.push_back(1);
    }
  }
  return std::make_unique<Texture>(map.width, map.height, Format::rgba16f, texels.data(),
                                   Sampling::panorama);
}

}  // namespace

/// Compiled once. Whether depth, thickness and back depth come about at once is the driver's
/// ability.
struct FluidRenderer::Passes {
  explicit Passes(bool one_pass)
      : sphere_depth(glsl_source, one_pass),
        thickness(one_pass ? nullptr : std::make_unique<Thickness>(glsl_source)),
        back_depth(one_pass ? nullptr : std::make_unique<BackDepth>(glsl_source)) {}
  Buffer frame{GL_UNIFORM_BUFFER};
  Neighborhoods particles;
  Crowding crowding;
  Anisotropy anisotropy;
  Sprites sprites;
  SphereDepth sphere_depth;
  std::unique_ptr<Thickness> thickness;
  std::unique_ptr<BackDepth> back_depth;
  Smooth smooth{glsl_source};
  CurvatureFlow curvature_flow{glsl_source};
  Normal normal{glsl_source};
  ColoredParticles colored;
  Spheres spheres{glsl_source};
  Tint tint{glsl_source};
  Composite composite{glsl_source};
  Resolve resolve{glsl_source};
};

struct FluidRenderer::Targets {
  Targets(int w, int h)
      : depth(w, h, Format::r32f),
        thickness(w, h, Format::r32f),
        back(w, h, Format::r32f),
        depth_thickness_back({&depth.texture, &thickness.texture, &back.texture}),
        between(w, h, Format::r32f),
        depth_smooth(w, h, Format::r32f),
        thickness_smooth(w, h, Format::r32f),
        back_smooth(w, h, Format::r32f),
        normal(w, h, Format::rgba32f),
        color(w, h, Format::srgb8),
        tiles(w, h),
        width(w),
        height(h) {}
  Target depth, thickness, back;        ///< affine depth; [m]; affine depth
  Framebuffer depth_thickness_back;     ///< all of these at once
  Target between;                       ///< a filter's first half
  Target depth_smooth;                  ///< affine depth
  Target thickness_smooth;              ///< [m]
  Target back_smooth;                   ///< affine depth
  Target normal;                        ///< eye space
  Target color;                         ///< multiplied by alpha
  FluidTiles tiles;                     ///< where any of these can hold fluid
  std::unique_ptr<MeshTargets> meshes;  ///< made by the first picture that has some

  /// Made by the first picture that needs it.
  struct Spheres {
    explicit Spheres(const Targets& to)
        : nearest(to.width, to.height, Format::depth32f),
          framebuffer({&to.depth.texture, &to.normal.texture, &nearest}) {}
    Texture nearest;
    Framebuffer framebuffer;  ///< affine depth; normal and color
  };
  std::unique_ptr<Spheres> spheres;
  std::unique_ptr<Target> tint;  ///< weight times color, weight
  int width, height;
};

FluidRenderer::FluidRenderer(int width, int height, const std::string& device)
    : FluidRenderer(checked_side(width, "width"),
                    checked_side(height, "height"),
                    std::make_unique<EglContext>(device)) {}

FluidRenderer::FluidRenderer(int width, int height, std::unique_ptr<EglContext> context)
    : width_(checked_side(width, "width")),
      height_(checked_side(height, "height")),
      context_(std::move(context)) {
  const auto current = context_->make_current();
  require_drawable(width, height, 1);
  auto passes = std::make_unique<Passes>(context_->has_version(4, 0));
  require_no_gl_error();
  prepare_targets(1);
  passes_ = std::move(passes);  // nothing throws from here on, when the context is not current
}

void FluidRenderer::prepare_targets(int factor) {
  if (targets_ != nullptr && targets_->width == factor * width_) return;
  require_drawable(width_, height_, factor);
  targets_ = std::make_unique<Targets>(factor * width_, factor * height_);
}

FluidRenderer::~FluidRenderer() {
  try {
    const auto current = context_->make_current();
    targets_.reset();
    passes_.reset();
    environment_map_.reset();
  } catch (const Error&) {
    // In a forked child, or after the device was lost, there are no OpenGL names to give back.
    (void)targets_.release();
    (void)passes_.release();
    (void)environment_map_.release();
  }
}

template <class F>
void FluidRenderer::stage(const char* name, F&& pass) {
  const auto start = std::chrono::steady_clock::now();
  pass();
  if (!timed_) return;
  glFinish();
  const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - start;
  report_.milliseconds.emplace_back(name, time.count());
}

Surface FluidRenderer::draw(const PointsView& positions,
                            const Camera& camera,
                            const RenderParams& params,
                            const Colors& colors,
                            bool with_back) {
  report_ = {.particles = positions.cols(), .milliseconds = {}};
  const FrameBlock frame = frame_block(camera, targets_->width, targets_->height);
  passes_->frame.upload(&frame, sizeof frame);
  passes_->frame.bind_base(0);
  if (params.style == Style::spheres) return draw_spheres(positions, camera, frame, params, colors);
  Surface surface = draw_fluid(positions, camera, frame, params, with_back);
  if (!colors.empty()) {
    surface.tint = &draw_tint(positions, camera, frame, surface.depth, params, colors);
  }
  return surface;
}

Surface FluidRenderer::draw_spheres(const PointsView& positions,
                                    const Camera& camera,
                                    const FrameBlock& frame,
                                    const RenderParams& params,
                                    const Colors& colors) {
  Targets& to = *targets_;
  const Real radius = params.sphere_radius_in_force();
  stage("upload", [&] {
    const Colors all_alike(static_cast<std::size_t>(positions.cols()),
                           encoded_color(params.sphere_color));
    passes_->colored.upload(positions, colors.empty() ? all_alike : colors, radius, camera.eye,
                            frame);
    to.tiles.find(positions, frame, radius);
  });
  if (to.spheres == nullptr) to.spheres = std::make_unique<Targets::Spheres>(to);
  stage("spheres", [&] { passes_->spheres(passes_->colored, radius, to.spheres->framebuffer); });
  return {to.tiles,         to.depth.texture,  to.thickness.texture,
          to.depth.texture, to.normal.texture, to.depth.texture,
          nullptr};
}

const Texture& FluidRenderer::draw_tint(const PointsView& positions,
                                        const Camera& camera,
                                        const FrameBlock& frame,
                                        const Texture& depth,
                                        const RenderParams& params,
                                        const Colors& colors) {
  Targets& to = *targets_;
  if (to.tint == nullptr) {
    // Half as fine as the picture: colors have no edges within a surface.
    to.tint = std::make_unique<Target>((to.width + 1) / 2, (to.height + 1) / 2, Format::rgba32f);
  }
  stage("tint", [&] {
    passes_->colored.upload(positions, colors, params.radius, camera.eye, frame);
    passes_->tint(passes_->colored, depth, params.radius, to.tint->framebuffer);
  });
  return to.tint->texture;
}

Surface FluidRenderer::draw_fluid(const PointsView& positions,
                                  const Camera& camera,
                                  const FrameBlock& frame,
                                  const RenderParams& params,
                                  bool with_back) {
  Passes& pass = *passes_;
  Targets& to = *targets_;
  const bool stretched = params.anisotropy > 0;
  stage("crowding", [&] {
    pass.particles.find(
        positions, camera, params.neighbor_distance(), params.radius, Neighborhoods::Deep::last,
        stretched ? Neighborhoods::Sorted::shallow : Neighborhoods::Sorted::around_loose);
    if (params.drop_radius) pass.crowding.find(pass.particles);
  });
  const Real nearest = nearest_front(pass.particles.shallow(), params.radius, frame, 0);
  const Records& particles = pass.particles.particles();
  if (stretched) {
    stage("anisotropy",
          [&] { pass.anisotropy.find(pass.particles, particles.size(), params.anisotropy); });
  }
  stage("upload", [&] {
    if (stretched) {
      const Records& centers = pass.anisotropy.centers();
      pass.sprites.upload(centers, pass.anisotropy.stretches());
      to.tiles.find(centers, pass.anisotropy.stretches(), frame, params.radius);
    } else {
      pass.sprites.upload(particles);
      to.tiles.find(pass.particles.shallow(), frame, params.radius);
    }
  });
  if (pass.thickness == nullptr) {
    stage("sphere_depth",
          [&] { pass.sphere_depth(pass.sprites, params, to.depth_thickness_back); });
  } else {
    stage("sphere_depth", [&] { pass.sphere_depth(pass.sprites, params, to.depth.framebuffer); });
    stage("thickness", [&] { (*pass.thickness)(pass.sprites, params, to.thickness.framebuffer); });
    stage("back_depth", [&] { (*pass.back_depth)(pass.sprites, params, to.back.framebuffer); });
  }
  const auto smooth = [&](const LayerFilter& filter, int iterations, const Texture& values,
                          const Target& out) {
    const Texture* last = &values;
    iterate(filter, iterations, frame, nearest, [&](const LayerFilter& with) {
      pass.smooth(with, to.tiles, *last, to.depth.texture, to.between.framebuffer,
                  to.between.texture, out.framebuffer);
      last = &out.texture;
    });
    return last;
  };
  const Texture* depth = &to.depth.texture;
  stage("depth_smooth", [&] {
    const LayerFilter filter = depth_filter(params);
    if (filter.kind != Smoothing::curvature_flow) {
      depth = smooth(filter, params.smoothing_iterations, *depth, to.depth_smooth);
    } else if (params.smoothing_iterations > 0) {
      const FlowSchedule schedule =
          flow_schedule(filter, params.smoothing_iterations, frame, nearest);
      // What is in the other two is not needed yet.
      pass.curvature_flow(filter, schedule, to.tiles, *depth, *depth,
                          {&to.depth_smooth, &to.between, &to.thickness_smooth});
      depth = &to.depth_smooth.texture;
    }
  });
  if (with_back) {
    stage("back_smooth", [&] {
      pass.smooth(back_filter(params), to.tiles, to.back.texture, to.depth.texture,
                  to.between.framebuffer, to.between.texture, to.back_smooth.framebuffer);
    });
  }
  const Texture* thickness = &to.thickness.texture;
  stage("thickness_smooth", [&] {
    thickness = smooth(thickness_filter(params), params.thickness_iterations, *thickness,
                       to.thickness_smooth);
  });
  stage("normal",
        [&] { pass.normal(to.tiles, *depth, to.depth.texture, params, to.normal.framebuffer); });
  return {to.tiles,          *depth,           *thickness, to.back_smooth.texture,
          to.normal.texture, to.depth.texture, nullptr};
}

Image FluidRenderer::render(const PointsView& positions,
                            const Camera& camera,
                            const RenderParams& params,
                            const Meshes& meshes,
                            const ScalarsView& values) {
  require_sound(positions, camera, params, values, environment_map_ != nullptr);
  const ColorRange range = params.color_range.value_or(range_of(values));
  const auto current = context_->make_current();
  const int factor = params.supersampling;
  prepare_targets(factor);
  Targets& to = *targets_;
  const Surface surface =
      draw(positions, camera, params, colors_of(values, params.colormap, range), true);
  SunShadow shadow;
  stage("shadow", [&] {
    shadow = sun_shadow(positions, shadow_params(params, surface.tint != nullptr), meshes);
  });
  stage("composite", [&] {
    if (!meshes.empty() && to.meshes == nullptr) {
      to.meshes = std::make_unique<MeshTargets>(to.color.texture);
    }
    const Surroundings surroundings{
        .shadow = shadow, .meshes = &meshes, .map = environment_map_.get()};
    passes_->composite(surface, surroundings, camera, params, to.color.framebuffer,
                       meshes.empty() ? nullptr : to.meshes.get());
  });
  Image image;
  if (factor > 1 || params.background == Background::transparent) {
    const Target picture(width_, height_, Format::srgb8);
    stage("resolve",
          [&] { passes_->resolve(targets_->color.texture, factor, picture.framebuffer); });
    stage("read_back", [&] { image = read_rgba8(picture.texture); });
  } else {
    stage("read_back", [&] { image = read_rgba8(targets_->color.texture); });
  }
  require_no_gl_error();
  if (values.size() > 0 && !params.legend.empty()) {
    draw_legend(image, params.legend, params.colormap, range);
  }
  return image;
}

void FluidRenderer::set_environment_map(const std::optional<EnvironmentMap>& map) {
  const auto current = context_->make_current();
  environment_map_ = map ? panorama(*map) : nullptr;
  passes_->composite.forget_backdrop();
}

Layers FluidRenderer::layers(const PointsView& positions,
                             const Camera& camera,
                             const RenderParams& params) {
  require_sound(positions, camera, params);
  const auto current = context_->make_current();
  prepare_targets(1);
  const Surface surface = draw(positions, camera, params, {}, false);
  Layers layers;
  stage("read_back", [&] {
    if (params.style == Style::spheres) {
      layers.depth = read_depth(surface.depth, camera);
      layers.normal = read_floats(surface.normal, 3);
      return;
    }
    layers = {.depth = read_depth(targets_->depth.texture, camera),
              .depth_smooth = read_depth(surface.depth, camera),
              .thickness = read_floats(targets_->thickness.texture, 1),
              .thickness_smooth = read_floats(surface.thickness, 1),
              .normal = read_floats(surface.normal, 3)};
  });
  require_no_gl_error();
  return layers;
}

}  // namespace pbf
