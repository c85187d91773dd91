#include "pbf/render/passes/composite.hpp"
#include "pbf/render/raster/composite.hpp"
#include "pbf/render/raster/resolve.hpp"
#include "pbf/render/raster/terms.hpp"

#include "gl_fixture.hpp"
#include <cmath>

using namespace pbf;
using namespace pbf::test;

namespace {

constexpr int kSide = 65;

/// Linear red, green, blue of the middle pixel of a picture, row by row from any side.
std::array<double, 3> middle_of(const std::uint8_t* pixels) {
  const std::uint8_t* middle = pixels + 4 * (kSide * kSide / 2);
  std::array<double, 3> linear{};
  for (int k = 0; k < 3; ++k) {
    const double v = middle[k] / 255.0;
    linear[k] = v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
  }
  CHECK(middle[3] == 255);
  return linear;
}

using Seen = std::array<double, 3>(const RenderParams& params, double thickness, const Vec3& n);

/// What a camera that looks straight at, or along, a wall of fluid 2 m away sees of one gray
/// background, by shaders.
std::array<double, 3> seen_by_shaders(const RenderParams& params,
                                      double thickness,
                                      const Vec3& normal) {
  const Camera camera = GlFixture::looking_down_z();
  const GlFixture gl(kSide, kSide, camera);
  const Texture depth = gl.texture([](int, int) { return 0.5; });
  const Texture thick = gl.texture([&](int, int) { return thickness; });
  std::vector<float> data;
  for (int k = 0; k < kSide * kSide; ++k) {
    data.insert(data.end(), {normal.x(), normal.y(), normal.z(), 0});
  }
  const Texture back = gl.texture([&](int, int) { return 1 / (2 + thickness); });
  const Texture normals(kSide, kSide, Format::rgba32f, data.data());
  const Texture color(kSide, kSide, Format::srgb8);
  const Framebuffer out({&color});
  Composite pass(glsl_source);
  pass({gl.tiles(), depth, thick, back, normals, depth, nullptr}, {.shadow = SunShadow{}}, camera,
       params, out);
  std::vector<std::uint8_t> pixels(kSide * kSide * 4);
  out.read(GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
  return middle_of(pixels.data());
}

/// The same by the pass in C++.
std::array<double, 3> seen_in_cpp(const RenderParams& params,
                                  double thickness,
                                  const Vec3& normal) {
  const Camera camera = GlFixture::looking_down_z();
  const auto map = [](double value) {
    return raster::Map(kSide, kSide, static_cast<float>(value));
  };
  const raster::Map depth = map(0.5), thick = map(thickness), back = map(1 / (2 + thickness));
  raster::NormalMaps normals(kSide, kSide);
  normals.x = map(normal.x());
  normals.y = map(normal.y());
  normals.z = map(normal.z());
  raster::Tiles tiles(kSide, kSide);
  for (int k = 0; k < tiles.columns() * tiles.rows(); ++k) {
    tiles.mark(k % tiles.columns(), k / tiles.columns());
  }
  Image image{kSide, kSide, 4, std::vector<std::uint8_t>(kSide * kSide * 4)};
  const raster::Scene scene = raster::scene_of(frame_block(camera, kSide, kSide),
                                               environment_of(params, camera), {}, nullptr);
  raster::Composite(scene, params, nullptr, raster::picture_of(image), 1)
      .draw({tiles, depth, thick, back, depth, normals, nullptr});
  return middle_of(image.data.data());
}

constexpr std::array<Seen*, 2> kBoth{seen_by_shaders, seen_in_cpp};

RenderParams plain() {
  RenderParams params;
  params.background = Background::plain;
  params.background_color = {0.7F, 0.7F, 0.7F};
  params.floor = false;
  params.scatter = {0, 0, 0};
  return params;
}

}  // namespace

TEST_CASE("composite: light is absorbed by exp(-absorption * thickness) in each channel") {
  for (Seen* seen : kBoth) {
    RenderParams params = plain();
    params.refractive_index = 1;  // no mirror
    params.absorption = {3.0F, 1.0F, 0.0F};
    for (const double thickness : {0.1, 0.5, 1.0}) {
      const auto color = seen(params, thickness, {0, 0, 1});
      for (int k = 0; k < 3; ++k) {
        const double expected = 0.7 * std::exp(-params.absorption[k] * thickness);
        CHECK(color[k] == doctest::Approx(expected).epsilon(0.02));  // 8 bits
      }
    }
  }
}

TEST_CASE("composite: fluid that absorbs all mirrors by Fresnel: 2 % head on, all at grazing") {
  for (Seen* seen : kBoth) {
    RenderParams params = plain();
    params.background_color = {0.8F, 0.8F, 0.8F};
    params.absorption = {1e6F, 1e6F, 1e6F};
    const double head_on = std::pow((1.333 - 1) / (1.333 + 1), 2);
    CHECK(seen(params, 1, {0, 0, 1})[0] / 0.8 == doctest::Approx(head_on).epsilon(0.1));
    const Vec3 grazing = Vec3(1, 0, 1e-3F).normalized();
    CHECK(seen(params, 1, grazing)[0] / 0.8 > 0.97);
    // 60 degrees: the mean of both polarizations.
    const double c = 0.5;
    const double t = std::sqrt(1 - 0.75 / (1.333 * 1.333));
    const double s = (c - 1.333 * t) / (c + 1.333 * t);
    const double p = (1.333 * c - t) / (1.333 * c + t);
    const Vec3 tilted(std::sqrt(0.75F), 0, 0.5F);
    CHECK(seen(params, 1, tilted)[0] / 0.8 == doctest::Approx((s * s + p * p) / 2).epsilon(0.05));
  }
}

TEST_CASE("composite: a wall of the tank that the bent ray meets too flat mirrors it") {
  for (Seen* seen : kBoth) {
    RenderParams params = plain();
    params.absorption = {1.0F, 0.5F, 0.0F};
    params.tank_lower = Vec3(-5, -5, -4);
    params.tank_upper = Vec3(0.1F, 5, -2);
    // The surface is 2 m away, where the tank begins; the fluid fills it, 2 m deep.
    for (const double degrees : {0.0, 20.0, 40.0}) {
      CAPTURE(degrees);
      const double tilt = degrees * 3.14159265 / 180;
      const double inside = std::asin(std::sin(tilt) / 1.333);
      // Bent towards +x, where the wall is 0.1 m away; mirrored there, so that the way to the far
      // wall is as long as if that wall were not there.
      const double way = 2 / std::cos(tilt - inside);
      const double c = std::cos(tilt), t = std::cos(inside);
      const double s = (c - 1.333 * t) / (c + 1.333 * t);
      const double p = (1.333 * c - t) / (1.333 * c + t);
      const double mirrored = (s * s + p * p) / 2;
      const Vec3 normal(static_cast<Real>(-std::sin(tilt)), 0, static_cast<Real>(c));
      const auto color = seen(params, 2, normal);
      for (int k = 0; k < 3; ++k) {
        const double left = std::exp(-params.absorption[k] * way);
        CHECK(color[k] ==
              doctest::Approx(0.7 * (mirrored + (1 - mirrored) * left)).epsilon(0.02));  // 8 bits
      }
    }
  }
}
