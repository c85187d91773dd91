#include "pbf/render/passes/curvature_flow.hpp"

#include "pbf/render/passes/sphere_depth.hpp"

namespace pbf {

CurvatureFlow::CurvatureFlow(const GlslSource& source)
    : program_(source,
               {.vertex = {"frame.glsl", "fluid_tiles.vert"},
                .fragment = {"frame.glsl", "curvature_flow.frag"},
                .defines = {}}) {}

void CurvatureFlow::operator()(const LayerFilter& filter,
                               const FlowSchedule& schedule,
                               const FluidTiles& tiles,
                               const Texture& depth,
                               const Texture& spheres,
                               const std::array<const Target*, 3>& targets) const {
  program_.use();
  program_.set("u_values", 0);
  program_.set("u_previous", 1);
  program_.set("u_spheres", 2);
  program_.set("u_stages", static_cast<float>(schedule.stages));
  program_.set("u_variance", schedule.variance);
  program_.set("u_range", filter.range);
  spheres.bind(2);
  const Texture* last = &depth;
  const Texture* before = &depth;
  for (int k = schedule.steps * schedule.stages - 1; k >= 0; --k) {
    const int stage = schedule.stages - k % schedule.stages;
    if (stage == 1) before = last;  // a step begins
    const Target& out = *targets[static_cast<std::size_t>(k % 3)];
    last->bind(0);
    before->bind(1);
    program_.set("u_j", static_cast<float>(stage));
    out.framebuffer.clear(0, {kNothing, 0, 0, 0});
    tiles.draw();
    before = last;
    last = &out.texture;
  }
}

}  // namespace pbf
