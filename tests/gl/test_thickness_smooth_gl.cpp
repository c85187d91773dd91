#include "pbf/render/passes/thickness_smooth.hpp"

#include "gl_fixture.hpp"
#include <numeric>

using namespace pbf;
using namespace pbf::test;

namespace {

std::vector<float> smooth(const GlFixture& gl, const Texture& thickness, Smoothing smoothing) {
  const ThicknessSmooth pass(glsl_source);
  const Texture depth = gl.texture([](int, int) { return 0.5; });
  const Texture between(gl.width(), gl.height(), Format::r32f);
  const Texture result(gl.width(), gl.height(), Format::r32f);
  RenderParams params;
  params.thickness_smoothing = smoothing;
  params.thickness_radius = 0.2F;
  params.thickness_range = 0.1F;
  pass(gl.tiles(), thickness, depth, params, Framebuffer({&between}), between,
       Framebuffer({&result}));
  return gl.read(result);
}

}  // namespace

TEST_CASE("thickness_smooth: a constant stays constant and pixels without fluid carry no weight") {
  const GlFixture gl;
  const auto hole = [](int x, int y) { return x > 40 && y > 20; };
  const Texture thickness = gl.texture([&](int x, int y) { return hole(x, y) ? 0.0 : 0.25; });
  for (const Smoothing smoothing : {Smoothing::bilateral, Smoothing::gaussian}) {
    const std::vector<float> result = smooth(gl, thickness, smoothing);
    for (int y = 0; y < gl.height(); ++y) {
      for (int x = 0; x < gl.width(); ++x) {
        CHECK(result[gl.at(x, y)] == (hole(x, y) ? 0.0F : 0.25F));
      }
    }
  }
}

TEST_CASE("thickness_smooth: a wedge stays a wedge and a high step is kept or spread by name") {
  const GlFixture gl;
  const Texture wedge = gl.texture([](int x, int) { return 0.1 + 0.002 * x; });
  const Texture step = gl.texture([](int x, int) { return x < 32 ? 0.1 : 0.3; });
  for (const Smoothing smoothing : {Smoothing::bilateral, Smoothing::gaussian}) {
    const std::vector<float> result = smooth(gl, wedge, smoothing);
    for (int x = 0; x < gl.width(); ++x) {
      CHECK(result[gl.at(x, 10)] == doctest::Approx(0.1 + 0.002 * x).epsilon(1e-5));
    }
  }
  CHECK(smooth(gl, step, Smoothing::bilateral)[gl.at(31, 10)] == 0.1F);
  CHECK(smooth(gl, step, Smoothing::gaussian)[gl.at(31, 10)] > 0.14F);
}
