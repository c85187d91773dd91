#include "pbf/render/passes/back_depth.hpp"
#include "pbf/render/raster/splats.hpp"

#include "gl_fixture.hpp"
#include <cmath>

using namespace pbf;
using namespace pbf::test;

TEST_CASE("back_depth: the far side of the farthest sphere, by shaders and in C++") {
  const int width = 160, height = 120;
  Points centers(3, 3);
  centers.col(0) = Vec3(0.2F, 0.1F, -2.0F);
  centers.col(1) = Vec3(0.4F, 0.0F, -3.0F);
  centers.col(2) = Vec3(-0.3F, 0.2F, -1.5F);
  RenderParams params;
  params.radius = 0.3F;
  for (const bool orthographic : {false, true}) {
    CAPTURE(orthographic);
    Camera camera = GlFixture::looking_down_z();
    camera.orthographic = orthographic;
    camera.height = 2;
    const GlFixture gl(width, height, camera);
    Sprites sprites;
    sprites.upload(particles(centers));
    const Texture alone(width, height, Format::r32f), together(width, height, Format::r32f);
    const Texture depth(width, height, Format::r32f), thickness(width, height, Format::r32f);
    BackDepth pass(glsl_source);
    pass(sprites, params, Framebuffer({&alone}));
    SphereDepth all(glsl_source, true);
    all(sprites, params, Framebuffer({&depth, &thickness, &together}));
    const std::vector<float> result = gl.read(alone);
    CHECK(result == gl.read(together));

    raster::Splats splats;
    const raster::SplatView view = raster::splat_view(gl.frame(), params);
    raster::Map front(width, height, kNothing), sum(width, height, 0),
        back(width, height, kNothing);
    const Records records = particles(centers);
    splats.bin(records.data(), records.size(), view, 1);
    splats.draw(view, front, sum, back, 1);

    int seen = 0;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const double slope_x = gl.slope_x(x), slope_y = gl.slope_y(y);
        const Eigen::Vector3d origin(orthographic ? slope_x : 0, orthographic ? slope_y : 0, 0);
        const Eigen::Vector3d ray(slope_x - origin.x(), slope_y - origin.y(), -1);
        double expected = 0, margin = 1;
        for (int k = 0; k < 3; ++k) {
          const Eigen::Vector3d c = centers.col(k).cast<double>() - origin;
          const double b = ray.dot(c), r2 = 0.09;
          const double h = b * b - ray.squaredNorm() * (c.squaredNorm() - r2);
          margin = std::min(margin, std::abs(h / ray.squaredNorm() / r2));
          if (h > 0) expected = std::max(expected, (b + std::sqrt(h)) / ray.squaredNorm());
        }
        if (margin < 0.02) continue;  // the rim, where the depth changes without limit
        const float a = result[gl.at(x, y)], in_cpp = back.row(y)[x];
        if (expected == 0) {
          CHECK(a == BackDepth::kNone);
          CHECK(in_cpp == kNothing);
          continue;
        }
        ++seen;
        CHECK((orthographic ? -a : 1 / a) == doctest::Approx(expected).epsilon(1e-5));
        CHECK((orthographic ? -in_cpp : 1 / in_cpp) == doctest::Approx(expected).epsilon(1e-5));
      }
    }
    CHECK(seen > 1000);
  }
}
