#include "pbf/render/passes/backdrop.hpp"

#include "pbf/gl/draw.hpp"
#include "pbf/gl/error.hpp"
#include "pbf/render/passes/fluid_tiles.hpp"
#include "pbf/render/shadow_rectangle.hpp"

namespace pbf {

Backdrop::Backdrop(const GlslSource& source)
    : program_(source,
               {.vertex = {"frame.glsl", "fluid_tiles.vert"},
                .fragment = {"frame.glsl", "environment.glsl", "display.glsl", "backdrop.frag"},
                .defines = {}}),
      squares_(GL_ARRAY_BUFFER) {
  squares_array_.instances(squares_, 3, 0);
  // An error in a shader shows now.
  (void)program_.with(environment_defines(environment_of({}, {}), true));
}

void Backdrop::operator()(const Surroundings& surroundings,
                          const Camera& camera,
                          const RenderParams& params,
                          const Framebuffer& out) {
  const bool stays = kept_ != nullptr && kept_->picture.texture.width() == out.width() &&
                     kept_->picture.texture.height() == out.height() &&
                     same(kept_->camera, camera) && same(kept_->params, params);
  if (!stays) {
    kept_.reset();
    auto kept = std::make_unique<Kept>(
        Kept{camera, params, Target(out.width(), out.height(), Format::srgb8)});
    draw(false, surroundings, camera, params, kept->picture.framebuffer);
    require_no_gl_error();  // what comes of one is not kept
    kept_ = std::move(kept);
  }
  kept_->picture.framebuffer.copy_to(out);
  draw(true, surroundings, camera, params, out);
}

void Backdrop::draw(bool in_shadow,
                    const Surroundings& surroundings,
                    const Camera& camera,
                    const RenderParams& params,
                    const Framebuffer& out) {
  constexpr int kSide = FluidTiles::kSide;
  const Environment environment = environment_of(params, camera);
  const Rectangle all{0, 0, out.width(), out.height()};
  const Rectangle reach = in_shadow ? shadow_rectangle(surroundings.shadow, camera, environment,
                                                       out.width(), out.height())
                                    : all;
  std::vector<float> corners;
  for (int y = reach.y0 / kSide * kSide; y < reach.y1; y += kSide) {
    for (int x = reach.x0 / kSide * kSide; x < reach.x1; x += kSide) {
      for (const int value : {x, y, kSide}) corners.push_back(static_cast<float>(value));
    }
  }
  if (corners.empty()) return;
  out.bind();
  const Program& program = program_.with(environment_defines(environment, in_shadow));
  program.use();
  set_environment(program, surroundings, environment);
  squares_.upload(corners.data(), static_cast<GLsizeiptr>(corners.size() * sizeof(float)));
  set_draw_state(Blend::replace);
  squares_array_.bind();
  glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(corners.size() / 3));
}

}  // namespace pbf
