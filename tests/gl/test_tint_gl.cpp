#include "pbf/render/passes/tint.hpp"

#include "gl_fixture.hpp"
#include <cmath>

using namespace pbf;
using namespace pbf::test;

TEST_CASE("tint: the mean of the colors along a ray, weighted by chord and nearness") {
  // Looking along the axis through two spheres: both chords are diameters.
  Camera camera = GlFixture::looking_down_z();
  camera.orthographic = true;
  camera.height = 2;
  const GlFixture gl(65, 65, camera);
  const Real radius = 0.5F;
  Tint pass(glsl_source);
  for (const double gap : {0.0, 0.2, 1.0}) {
    Points x(3, 2);
    x.col(0) = Vec3(0, 0, -2);
    x.col(1) = Vec3(0, 0, static_cast<Real>(-2 - gap));
    const Texture depth = gl.texture([&](int, int) { return -1.5; });  // affine: the first's front
    const Texture sums(65, 65, Format::rgba32f);
    const Framebuffer out({&sums});
    ColoredParticles particles;
    particles.upload(x, {0xFF0000, 0x00FF00}, radius, camera.eye, gl.frame());
    pass(particles, depth, radius, out);
    std::vector<float> data(65UL * 65 * 4);
    out.read(GL_RGBA, GL_FLOAT, data.data());
    const float* middle = data.data() + 4 * gl.at(32, 32);
    const double second = 2 * std::exp(-gap / double(radius));
    CHECK(middle[0] == doctest::Approx(2.0).epsilon(1e-3));
    CHECK(middle[1] == doctest::Approx(second).epsilon(1e-3));
    CHECK(middle[2] == 0);
    CHECK(middle[3] == doctest::Approx(2 + second).epsilon(1e-3));
    CHECK(data[0] == 0);
    CHECK(data[3] == 0);
  }
}

TEST_CASE("tint: nothing is added where there is no fluid") {
  const GlFixture gl;
  const Texture depth = gl.texture([](int, int) { return double(kNothing); });
  const Texture sums(gl.width(), gl.height(), Format::rgba32f);
  const Framebuffer out({&sums});
  ColoredParticles particles;
  Tint pass(glsl_source);
  particles.upload(Points(Vec3(0, 0, -2)), {0xFFFFFF}, 0.5F, Vec3::Zero(), gl.frame());
  pass(particles, depth, 0.5F, out);
  for (const float sum : gl.read(sums, 3)) CHECK(sum == 0);
}
