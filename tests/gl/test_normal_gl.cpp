#include "pbf/render/passes/normal.hpp"

#include "gl_fixture.hpp"
#include <cmath>

using namespace pbf;
using namespace pbf::test;

namespace {
const RenderParams kParams{.smoothing_range = 0.1F};
}

TEST_CASE("normal: of a tilted plane within 0.1 degrees, at any field of view, border included") {
  for (const float fov : {20.0F, 60.0F, 100.0F}) {
    for (const double tilt : {0.0, 0.5, 1.0}) {
      Camera camera = GlFixture::looking_down_z();
      camera.fov_y = fov;
      const GlFixture gl(96, 64, camera);
      const Normal pass(glsl_source);
      // z = -3 + tilt * y in eye space, so that its normal is (0, -tilt, 1).
      const auto slope = [&](int y) { return 1 + tilt * gl.slope_y(y); };
      const Texture depth =
          gl.texture([&](int, int y) { return slope(y) > 0.05 ? slope(y) / 3 : double{kNothing}; });
      const Texture result(gl.width(), gl.height(), Format::rgba32f);
      const Texture body = gl.texture([](int, int) { return 0.5; });
      pass(gl.tiles(), depth, body, kParams, Framebuffer({&result}));
      const std::vector<float> normals = gl.read(result, 3);
      double worst = 0;
      for (int y = 0; y < gl.height(); ++y) {
        for (int x = 0; x < gl.width(); ++x) {
          if (slope(y) <= 0.05) continue;
          const float* n = &normals[3 * gl.at(x, y)];
          const double sine = std::hypot(n[0], (n[1] + tilt * n[2]) / std::sqrt(1 + tilt * tilt));
          worst = std::max(worst, std::asin(std::min(sine, 1.0)) * 180 / std::numbers::pi);
        }
      }
      CAPTURE(fov);
      CAPTURE(tilt);
      CHECK(worst < 0.1);
    }
  }
}

TEST_CASE("normal: takes the side that belongs to the surface, and faces the viewer when alone") {
  const GlFixture gl;
  const Normal pass(glsl_source);
  const Texture body = gl.texture([](int, int) { return 0.5; });
  const Texture step = gl.texture([](int x, int) { return x < 32 ? 0.5 : 0.4; });
  const Texture result(gl.width(), gl.height(), Format::rgba32f);
  pass(gl.tiles(), step, body, kParams, Framebuffer({&result}));
  const std::vector<float> at_step = gl.read(result, 3);
  for (const int x : {31, 32}) {
    CHECK(at_step[3 * gl.at(x, 24) + 2] == doctest::Approx(1).epsilon(1e-4));
  }
  const Texture alone =
      gl.texture([](int x, int y) { return x == 5 && y == 5 ? 0.5 : double{kNothing}; });
  pass(gl.tiles(), alone, body, kParams, Framebuffer({&result}));
  const std::vector<float> lone = gl.read(result, 3);
  CHECK(lone[3 * gl.at(5, 5) + 2] == 1.0F);
  CHECK(lone[3 * gl.at(6, 5) + 2] == 0.0F);
  // A strand a pixel wide before one thing and beside another: the smaller step is none of its own.
  const Texture strand = gl.texture([](int x, int) {
    return 1 / (x < 32 ? 4.0 : x == 32 ? 2.0 : 2.5);
  });
  pass(gl.tiles(), strand, body, kParams, Framebuffer({&result}));
  CHECK(gl.read(result, 3)[3 * gl.at(32, 24) + 2] == doctest::Approx(1).epsilon(1e-3));
}
