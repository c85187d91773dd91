#include "pbf/render/passes/thickness.hpp"

#include "gl_fixture.hpp"
#include <numeric>

using namespace pbf;
using namespace pbf::test;

TEST_CASE("thickness: summed over a parallel view it is the fluid's volume, whatever the radius") {
  Camera camera = GlFixture::looking_down_z();
  camera.orthographic = true;
  camera.height = 1.0F;
  const GlFixture gl(256, 256, camera);
  Points centers(3, 50);
  for (int i = 0; i < 50; ++i) {
    centers.col(i) =
        Vec3(0.06F * static_cast<Real>(i % 7) - 0.2F, 0.05F * static_cast<Real>(i % 5) - 0.1F,
             -1.0F - 0.02F * static_cast<Real>(i));
  }
  Sprites sprites;
  sprites.upload(particles(centers));
  const double pixel_area = 1.0 / (256.0 * 256.0);
  for (const Real scale : {1.0F, 2.0F, 3.0F}) {
    RenderParams params;
    params.radius = 0.03F * scale;
    params.particle_volume = 1e-4F;
    const Texture thickness(256, 256, Format::r32f);
    Thickness pass(glsl_source);
    pass(sprites, params, Framebuffer({&thickness}));
    const std::vector<float> result = gl.read(thickness);
    const double volume = std::accumulate(result.begin(), result.end(), 0.0) * pixel_area;
    CAPTURE(scale);
    CHECK(volume == doctest::Approx(50 * 1e-4).epsilon(0.01));
  }
}

TEST_CASE("thickness: alone and together with the depth it is the same") {
  const GlFixture gl;
  REQUIRE(gl.context().has_version(4, 0));
  Sprites sprites;
  sprites.upload(particles(Points(Vec3(0.2F, 0.1F, -2.0F))));
  RenderParams params;
  params.radius = 0.3F;
  const Texture alone(gl.width(), gl.height(), Format::r32f);
  const Texture together(gl.width(), gl.height(), Format::r32f);
  const Texture depth(gl.width(), gl.height(), Format::r32f);
  Thickness pass(glsl_source);
  pass(sprites, params, Framebuffer({&alone}));
  SphereDepth both(glsl_source, true);
  const Texture back(gl.width(), gl.height(), Format::r32f);
  both(sprites, params, Framebuffer({&depth, &together, &back}));
  CHECK(gl.read(alone) == gl.read(together));
}
