#include "pbf/render/passes/depth_smooth.hpp"

#include "gl_fixture.hpp"
#include <bit>
#include <cmath>

using namespace pbf;
using namespace pbf::test;

namespace {

RenderParams params_for(Smoothing smoothing, Real radius = 0.2F, Real range = 0.1F) {
  RenderParams params;
  params.smoothing = smoothing;
  params.smoothing_radius = radius;
  params.smoothing_range = range;
  return params;
}

/// @param level  of the depth's last bits: 0 in a body of fluid, 3 for a drop (glsl/frame.glsl)
std::vector<float> smooth(const GlFixture& gl,
                          const Texture& depth,
                          const RenderParams& params,
                          std::uint32_t level = 0) {
  const DepthSmooth pass(glsl_source);
  const float tagged = std::bit_cast<float>(std::bit_cast<std::uint32_t>(1.0F) | level);
  const Texture spheres = gl.texture([&](int, int) { return tagged; });
  const Texture between(gl.width(), gl.height(), Format::r32f);
  const Texture result(gl.width(), gl.height(), Format::r32f);
  pass(gl.tiles(), depth, spheres, params, Framebuffer({&between}), between,
       Framebuffer({&result}));
  return gl.read(result);
}

constexpr double kHere = 2.0;  // depth of most surfaces here [m]

}  // namespace

TEST_CASE("depth_smooth: a constant stays constant, at the border and around a hole too") {
  const GlFixture gl;
  for (const Smoothing smoothing : {Smoothing::bilateral, Smoothing::gaussian}) {
    const auto hole = [](int x, int y) { return std::hypot(x - 30, y - 20) < 6; };
    const Texture depth =
        gl.texture([&](int x, int y) { return hole(x, y) ? kNothing : 1 / kHere; });
    const std::vector<float> result = smooth(gl, depth, params_for(smoothing));
    for (int y = 0; y < gl.height(); ++y) {
      for (int x = 0; x < gl.width(); ++x) {
        CHECK(result[gl.at(x, y)] == (hole(x, y) ? kNothing : 0.5F));
      }
    }
  }
}

TEST_CASE("depth_smooth: a tilted plane stays that plane, at the border and around a hole too") {
  for (const bool orthographic : {false, true}) {
    Camera camera = GlFixture::looking_down_z();
    camera.orthographic = orthographic;
    camera.height = 2;
    const GlFixture gl(64, 48, camera);
    // Depth d of the plane d = 2 + 0.5 x - 0.3 y, hit by the pixel's ray.
    const auto plane = [&](int x, int y) {
      const double tilt = 0.5 * gl.slope_x(x) - 0.3 * gl.slope_y(y);
      return orthographic ? kHere + tilt : kHere / (1 - tilt);
    };
    const auto hole = [](int x, int y) { return std::hypot(x - 50, y - 8) < 5; };
    const Texture depth = gl.texture([&](int x, int y) {
      if (hole(x, y)) return static_cast<double>(kNothing);
      return orthographic ? -plane(x, y) : 1 / plane(x, y);
    });
    for (const Smoothing smoothing : {Smoothing::bilateral, Smoothing::gaussian}) {
      const std::vector<float> result = smooth(gl, depth, params_for(smoothing));
      double worst = 0;
      for (int y = 0; y < gl.height(); ++y) {
        for (int x = 0; x < gl.width(); ++x) {
          if (hole(x, y)) continue;
          const double d = orthographic ? -result[gl.at(x, y)] : 1 / result[gl.at(x, y)];
          worst = std::max(worst, std::abs(d / plane(x, y) - 1));
        }
      }
      CAPTURE(orthographic);
      CHECK(worst < 2e-6);  // rounding of float32
    }
  }
}

TEST_CASE(
    "depth_smooth: a step higher than the range is kept by bilateral and spread by gaussian") {
  const GlFixture gl;
  const auto step = [](int x, int) { return 1 / (x < 32 ? kHere : kHere + 0.101); };
  const Texture depth = gl.texture(step);
  const std::vector<float> kept = smooth(gl, depth, params_for(Smoothing::bilateral));
  const std::vector<float> spread = smooth(gl, depth, params_for(Smoothing::gaussian));
  for (int x = 0; x < gl.width(); ++x) {
    CHECK(kept[gl.at(x, 24)] == static_cast<float>(step(x, 0)));
  }
  CHECK(1 / spread[gl.at(31, 24)] > kHere + 0.02);
  CHECK(1 / spread[gl.at(32, 24)] < kHere + 0.08);
}

TEST_CASE(
    "depth_smooth: the answer to an impulse is the kernel, whose width is a length in the scene") {
  Camera camera = GlFixture::looking_down_z();
  camera.orthographic = true;
  camera.height = 4.8F;  // a pixel is 0.1 m
  const GlFixture gl(64, 48, camera);
  const Texture impulse = gl.texture([](int x, int y) { return x == 32 && y == 24 ? -1.0 : -2.0; });
  const double radius = 5.5;  // pixels; the standard deviation is half of it
  const std::vector<float> result =
      smooth(gl, impulse, params_for(Smoothing::gaussian, static_cast<Real>(0.1 * radius)));
  const auto weight = [&](int k) {
    const double fade = std::clamp(radius + 1 - std::abs(k), 0.0, 1.0);
    return std::exp(-0.5 * k * k / (0.25 * radius * radius)) * fade;
  };
  double total = 0;
  for (int k = -6; k <= 6; ++k) total += weight(k);
  for (int dy = -8; dy <= 8; ++dy) {
    for (int dx = -8; dx <= 8; ++dx) {
      // Symmetric neighbors: the fitted line's value in the middle is the weighted mean.
      const double expected = weight(dx) * weight(dy) / (total * total);
      CHECK(result[gl.at(32 + dx, 24 + dy)] + 2 ==
            doctest::Approx(expected).epsilon(1e-4).scale(0.01));
    }
  }
}

TEST_CASE("depth_smooth: the kernel shrinks with distance as things do") {
  // The same bump, seen at twice the distance with twice the resolution, is smoothed to the same
  // shape.
  const auto peak = [](int width, int height, double depth) {
    const GlFixture gl(width, height);
    const double pixel = 2 * std::tan(std::numbers::pi / 6) * depth / height;
    const Texture bump = gl.texture([&](int x, int y) {
      const double r = std::hypot(x + 0.5 - width / 2.0, y + 0.5 - height / 2.0) * pixel;
      return 1 / (depth - 0.1 * std::exp(-r * r / 0.02));
    });
    RenderParams params = params_for(Smoothing::bilateral, 0.3F, 0.4F);
    return depth - 1 / smooth(gl, bump, params)[gl.at(width / 2, height / 2)];
  };
  CHECK(peak(64, 48, 2) == doctest::Approx(peak(128, 96, 4)).epsilon(0.3));
  CHECK(peak(128, 96, 2) == doctest::Approx(peak(256, 192, 4)).epsilon(0.05));
}

TEST_CASE("depth_smooth: a drop stays as round as it is, a small group is smoothed a little") {
  const GlFixture gl;
  const Texture bump = gl.texture([](int x, int y) {
    return 1 / (kHere - 0.05 * std::exp(-0.02 * ((x - 32) * (x - 32) + (y - 24) * (y - 24))));
  });
  const RenderParams params = params_for(Smoothing::bilateral, 0.3F, 0.4F);
  CHECK(smooth(gl, bump, params, 3) == gl.read(bump));
  double last = 1 / gl.read(bump)[gl.at(32, 24)];  // depth of the peak
  for (const std::uint32_t level : {2U, 1U, 0U}) {
    const double peak = 1 / smooth(gl, bump, params, level)[gl.at(32, 24)];
    CHECK(peak > last + 1e-4);
    last = peak;
  }
}
