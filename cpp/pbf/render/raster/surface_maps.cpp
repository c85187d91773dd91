#include "pbf/render/raster/surface_maps.hpp"

#include "pbf/core/stopwatch.hpp"
#include "pbf/render/nearest.hpp"
#include "pbf/render/raster/curvature_flow.hpp"
#include "pbf/render/raster/smooth.hpp"

namespace pbf::raster {

SurfaceMaps::SurfaceMaps(int width, int height)
    : depth_(width, height, kNothing),
      thickness_(width, height, 0),
      depth_between_(width, height, kNothing),
      thickness_between_(width, height, 0),
      depth_out_(width, height, kNothing),
      thickness_out_(width, height, 0),
      depth_third_(width, height, kNothing),
      back_(width, height, kNothing),
      back_out_(width, height, kNothing),
      normal_(width, height) {}

template <class F>
void SurfaceMaps::stage(const char* name, F&& pass) {
  milliseconds_.emplace_back(name, 0);
  const Stopwatch stopwatch(milliseconds_.back().second);
  pass();
}

const Map* SurfaceMaps::smoothed(const LayerFilter& filter,
                                 int iterations,
                                 const FrameBlock& frame,
                                 Real nearest,
                                 const Map& values,
                                 Map& between,
                                 Map& out,
                                 int threads) {
  const Map* last = &values;
  iterate(filter, iterations, frame, nearest, [&](const LayerFilter& with) {
    smooth(with, frame, tiles(), *last, depth_, between, out, threads);
    last = &out;
  });
  return last;
}

void SurfaceMaps::find(const PointsView& positions,
                       const Camera& camera,
                       const RenderParams& params,
                       For purpose,
                       int threads) {
  const FrameBlock frame = frame_block(camera, depth_.width(), depth_.height());
  const SplatView view = splat_view(frame, params);
  const bool is_picture = purpose == For::picture;
  const bool stretched = params.anisotropy > 0;
  milliseconds_.clear();
  stage("crowding", [&] {
    particles_.find(
        positions, camera, params.neighbor_distance(), params.radius,
        is_picture ? Neighborhoods::Deep::left_out : Neighborhoods::Deep::last,
        stretched ? Neighborhoods::Sorted::shallow : Neighborhoods::Sorted::around_loose, threads);
    if (params.drop_radius) crowding_.find(particles_, threads);
  });
  const Records& particles = particles_.particles();
  if (stretched) {
    stage("anisotropy",
          [&] { anisotropy_.find(particles_, particles.size(), params.anisotropy, threads); });
  }
  stage("sphere_depth", [&] {
    if (stretched) {
      splats_.bin(anisotropy_.centers().data(), particles.size(), view, threads,
                  anisotropy_.stretches().data());
    } else {
      splats_.bin(particles.data(), particles.size(), view, threads);
    }
    splats_.draw(view, depth_, thickness_, back_, threads);
    if (!is_picture) return;
    deep_thickness_.find(positions, particles_.places(), view, threads);
    deep_thickness_.add_to(thickness_, tiles(), threads);
  });
  const Real nearest = nearest_front(particles_.shallow(), params.radius, frame, threads);
  stage("depth_smooth", [&] {
    const LayerFilter filter = depth_filter(params);
    const int iterations = params.smoothing_iterations;
    if (filter.kind == Smoothing::curvature_flow && iterations > 0) {
      curvature_flow(filter, flow_schedule(filter, iterations, frame, nearest), frame, tiles(),
                     depth_, depth_, {&depth_out_, &depth_between_, &depth_third_}, threads);
      smooth_depth_ = &depth_out_;
    } else {
      smooth_depth_ =
          smoothed(filter, iterations, frame, nearest, depth_, depth_between_, depth_out_, threads);
    }
  });
  if (is_picture) {
    stage("back_smooth", [&] {
      smooth(back_filter(params), frame, tiles(), back_, depth_, depth_between_, back_out_,
             threads);
    });
  }
  stage("thickness_smooth", [&] {
    smooth_thickness_ = smoothed(thickness_filter(params), params.thickness_iterations, frame,
                                 nearest, thickness_, thickness_between_, thickness_out_, threads);
  });
  stage("normal",
        [&] { raster::normal(*smooth_depth_, depth_, tiles(), frame, params, normal_, threads); });
}

}  // namespace pbf::raster
