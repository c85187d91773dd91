#include "pbf/render/raster/surface_maps.hpp"

#include "pbf/core/stopwatch.hpp"
#include "pbf/render/raster/smooth.hpp"

namespace pbf::raster {

SurfaceMaps::SurfaceMaps(int width, int height)
    : depth_(width, height, kNothing),
      thickness_(width, height, 0),
      depth_between_(width, height, kNothing),
      thickness_between_(width, height, 0),
      depth_out_(width, height, kNothing),
      thickness_out_(width, height, 0) {}

template <class F>
void SurfaceMaps::stage(const char* name, F&& pass) {
  milliseconds_.emplace_back(name, 0);
  const Stopwatch stopwatch(milliseconds_.back().second);
  pass();
}

void SurfaceMaps::find(const PointsView& positions,
                       const Camera& camera,
                       const RenderParams& params,
                       int threads) {
  const FrameBlock frame = frame_block(camera, depth_.width(), depth_.height());
  const SplatView view = splat_view(frame, params);
  milliseconds_.clear();
  stage("crowding", [&] {
    crowding_.find(positions, camera.eye, params.drop_radius ? 2 * params.radius : 0, threads);
  });
  stage("bin", [&] { splats_.bin(crowding_.particles(), view, threads); });
  stage("sphere_depth", [&] { splats_.draw(view, depth_, thickness_, threads); });
  smooth_depth_ = &depth_;
  stage("depth_smooth", [&] {
    for (int k = 0; k < params.smoothing_iterations; ++k) {
      smooth(depth_filter(params), frame, tiles(), *smooth_depth_, depth_, depth_between_,
             depth_out_, threads);
      smooth_depth_ = &depth_out_;
    }
  });
  smooth_thickness_ = &thickness_;
  stage("thickness_smooth", [&] {
    for (int k = 0; k < params.thickness_iterations; ++k) {
      smooth(thickness_filter(params), frame, tiles(), *smooth_thickness_, depth_,
             thickness_between_, thickness_out_, threads);
      smooth_thickness_ = &thickness_out_;
    }
  });
}

}  // namespace pbf::raster
