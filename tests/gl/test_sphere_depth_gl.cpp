#include "gl_fixture.hpp"
#include <bit>
#include <cmath>
#include <numbers>

using namespace pbf;
using namespace pbf::test;

TEST_CASE("sphere_depth: the front of spheres on and off the axis, at any field of view") {
  for (const float fov : {20.0F, 60.0F, 100.0F}) {
    Camera camera = GlFixture::looking_down_z();
    camera.fov_y = fov;
    const GlFixture gl(160, 120, camera);
    const Real reach = camera.half_height();
    Points centers(3, 2);
    centers.col(0) = Vec3(0, 0, -3);
    centers.col(1) = Vec3(3.3F * reach, 2.4F * reach, -3.2F);
    Sprites sprites;
    sprites.upload(particles(centers));
    RenderParams params;
    params.radius = 0.4F * reach;
    const Texture depth(gl.width(), gl.height(), Format::r32f);
    SphereDepth pass(glsl_source, false);
    pass(sprites, params, Framebuffer({&depth}));
    const std::vector<float> result = gl.read(depth);
    int seen = 0;
    for (int y = 0; y < gl.height(); ++y) {
      for (int x = 0; x < gl.width(); ++x) {
        const Eigen::Vector3d ray(gl.slope_x(x), gl.slope_y(y), -1);
        double expected = 0;
        double margin = 1;  // of the discriminant from 0, as a share of r^2
        for (int k = 0; k < 2; ++k) {
          const Eigen::Vector3d c = centers.col(k).cast<double>();
          const double b = ray.dot(c);
          const double r2 = static_cast<double>(params.radius) * params.radius;
          const double h = b * b - ray.squaredNorm() * (c.squaredNorm() - r2);
          margin = std::min(margin, std::abs(h / ray.squaredNorm() / r2));
          if (h > 0) expected = (b - std::sqrt(h)) / ray.squaredNorm();
        }
        if (margin < 0.02) continue;  // the rim, where the depth changes without limit
        const float a = result[gl.at(x, y)];
        if (expected == 0) {
          CHECK(a == kNothing);
        } else {
          ++seen;
          CHECK(1 / a == doctest::Approx(expected).epsilon(1e-5));
        }
      }
    }
    CAPTURE(fov);
    CHECK(seen > 300);
  }
}

TEST_CASE("sphere_depth: a drop has its own radius, and its depth says that it is one") {
  const GlFixture gl(160, 120);
  RenderParams params;
  params.radius = 0.4F;
  params.drop_radius = 0.1F;
  for (const int level : {0, 1, 2, 3}) {
    const Real crowding = 1 - static_cast<Real>(level) / 3;
    Sprites sprites;
    sprites.upload(particles(Points(Vec3(0, 0, -2)), crowding));
    const Texture depth(gl.width(), gl.height(), Format::r32f);
    SphereDepth pass(glsl_source, false);
    pass(sprites, params, Framebuffer({&depth}));
    const std::vector<float> result = gl.read(depth);
    const double radius = 0.1 + 0.3 * crowding;
    std::size_t covered = 0;
    for (const float a : result) {
      if (a == kNothing) continue;
      ++covered;
      CHECK((std::bit_cast<std::uint32_t>(a) & 3U) == static_cast<std::uint32_t>(level));
    }
    CAPTURE(level);
    const double pixel = gl.slope_x(81) - gl.slope_x(80);
    const double disc = std::numbers::pi * radius * radius / (4 - radius * radius);
    CHECK(static_cast<double>(covered) * pixel * pixel == doctest::Approx(disc).epsilon(0.03));
    CHECK(1 / result[gl.at(80, 60)] == doctest::Approx(2 - radius).epsilon(1e-3));
  }
}
