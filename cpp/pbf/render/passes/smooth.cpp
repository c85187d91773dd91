#include "pbf/render/passes/smooth.hpp"

#include "pbf/render/passes/sphere_depth.hpp"

namespace pbf {
namespace {

ProgramFiles files(const char* kind) {
  return {.vertex = {"frame.glsl", "fluid_tiles.vert"},
          .fragment = {"frame.glsl", "smooth.frag"},
          .defines = {kind}};
}

}  // namespace

Smooth::Smooth(const GlslSource& source)
    : bilateral_(source, files("BILATERAL")),
      gaussian_(source, files("GAUSSIAN")),
      narrow_range_(source, files("NARROW_RANGE")) {}

void Smooth::operator()(const LayerFilter& filter,
                        const FluidTiles& tiles,
                        const Texture& values,
                        const Texture& spheres,
                        const Framebuffer& between,
                        const Texture& between_texture,
                        const Framebuffer& out) const {
  const bool thickness = filter.layer == LayerFilter::Layer::thickness;
  const Program& program = filter.kind == Smoothing::gaussian       ? gaussian_
                           : filter.kind == Smoothing::narrow_range ? narrow_range_
                                                                    : bilateral_;
  program.use();
  program.set("u_values", 0);
  program.set("u_spheres", 1);
  program.set("u_thickness", thickness ? 1 : 0);
  program.set("u_far_side", filter.layer == LayerFilter::Layer::far_side ? 1 : 0);
  program.set("u_radius", filter.radius);
  program.set("u_range", filter.range);
  program.set("u_behind", filter.behind);
  program.set("u_close_gaps", filter.close_gaps ? 1 : 0);
  const float empty = thickness ? 0 : kNothing;
  spheres.bind(1);
  values.bind(0);
  between.clear(0, {empty, 0, 0, 0});
  program.set("u_axis", 1, 0);
  tiles.draw();
  between_texture.bind(0);
  out.clear(0, {empty, 0, 0, 0});
  program.set("u_axis", 0, 1);
  tiles.draw();
}

}  // namespace pbf
