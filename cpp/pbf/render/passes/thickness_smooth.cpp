#include "pbf/render/passes/thickness_smooth.hpp"

namespace pbf {

ThicknessSmooth::ThicknessSmooth(const GlslSource& source)
    : program_(source,
               {.vertex = {"frame.glsl", "fluid_tiles.vert"},
                .fragment = {"frame.glsl", "smooth.glsl", "thickness_smooth.frag"},
                .defines = {}}) {}

void ThicknessSmooth::operator()(const FluidTiles& tiles,
                                 const Texture& thickness,
                                 const Texture& depth,
                                 const RenderParams& params,
                                 const Framebuffer& between,
                                 const Texture& between_texture,
                                 const Framebuffer& out) const {
  program_.use();
  program_.set("u_values", 0);
  program_.set("u_depth", 1);
  program_.set("u_empty", 0.0F);
  program_.set("u_gaussian", params.thickness_smoothing == Smoothing::gaussian ? 1 : 0);
  program_.set("u_radius", params.thickness_radius_in_force());
  program_.set("u_range", params.thickness_range_in_force());
  depth.bind(1);
  thickness.bind(0);
  between.clear(0, {0, 0, 0, 0});
  program_.set("u_axis", 1, 0);
  tiles.draw();
  between_texture.bind(0);
  out.clear(0, {0, 0, 0, 0});
  program_.set("u_axis", 0, 1);
  tiles.draw();
}

}  // namespace pbf
