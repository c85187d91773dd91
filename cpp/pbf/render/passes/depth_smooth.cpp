#include "pbf/render/passes/depth_smooth.hpp"

#include "pbf/gl/draw.hpp"

namespace pbf {

DepthSmooth::DepthSmooth(const GlslSource& source)
    : program_(source,
               {.vertex = {"fullscreen.vert"},
                .fragment = {"frame.glsl", "smooth.glsl", "depth_smooth.frag"},
                .defines = {}}) {}

void DepthSmooth::operator()(const Texture& depth,
                             const RenderParams& params,
                             const Framebuffer& between,
                             const Texture& between_texture,
                             const Framebuffer& out) const {
  program_.use();
  program_.set("u_values", 0);
  program_.set("u_empty", -1e29F);
  program_.set("u_gaussian", params.smoothing == Smoothing::gaussian ? 1 : 0);
  program_.set("u_radius", params.smoothing_radius_in_force());
  program_.set("u_range", params.smoothing_range_in_force());
  depth.bind(0);
  between.bind();
  program_.set("u_axis", 1, 0);
  draw_fullscreen();
  between_texture.bind(0);
  out.bind();
  program_.set("u_axis", 0, 1);
  draw_fullscreen();
}

}  // namespace pbf
