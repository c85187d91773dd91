#include "pbf/render/passes/environment.hpp"
#include "pbf/render/shadow_rectangle.hpp"
#include "pbf/render/sun_shadow.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <random>

using namespace pbf;

namespace {

/// Points spread evenly over what the condition takes, `density` of them in a cubic meter.
template <class F>
Points spread(double density, double half, F&& inside) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> at(static_cast<float>(-half), static_cast<float>(half));
  std::vector<float> data;
  const auto tries = static_cast<int>(density * std::pow(2 * half, 3));
  for (int k = 0; k < tries; ++k) {
    const Vec3 p(at(random), at(random), at(random));
    if (inside(p)) data.insert(data.end(), p.data(), p.data() + 3);
  }
  return Eigen::Map<const Points>(data.data(), 3, static_cast<Index>(data.size() / 3));
}

/// Transmittance of a channel where the sun's ray through a point crosses the picture.
double at(const SunShadow& map, const Vec3& p, int channel) {
  const double u = map.x.dot(p - map.center) + 0.5;
  const double v = map.y.dot(p - map.center) + 0.5;
  if (u < 0 || v < 0 || u >= 1 || v >= 1) return 1;
  const int column = static_cast<int>(u * map.width);
  const int row = static_cast<int>(v * map.height);
  return map.transmittance[4 * (static_cast<std::size_t>(row) * map.width + column) + channel] /
         255.0;
}

RenderParams fine() {
  RenderParams params;
  params.radius = 0.02F;
  params.particle_volume = 1.0F / 200'000;
  params.absorption = {4.0F, 1.0F, 0.0F};
  return params;
}

}  // namespace

TEST_CASE("sun_shadow: below a slab light is absorbed along the slanted way through it") {
  const auto slab = [](const Vec3& p) { return std::abs(p.y()) < 0.1F; };
  const Points points = spread(200'000, 0.5, slab);
  for (const double degrees : {0.0, 30.0, 60.0}) {
    CAPTURE(degrees);
    const double angle = degrees * 3.14159265 / 180;
    RenderParams params = fine();
    params.sun_direction = {static_cast<Real>(std::sin(angle)), static_cast<Real>(std::cos(angle)),
                            0};
    const SunShadow map = sun_shadow(points, params);
    for (int c = 0; c < 3; ++c) {
      double mean = 0;  // over points in the middle: they were spread by chance
      for (int k = 0; k < 100; ++k) {
        const Vec3 p(-0.1F + 0.02F * static_cast<Real>(k / 10), 0,
                     -0.1F + 0.02F * static_cast<Real>(k % 10));
        mean += at(map, p, c) / 100;
      }
      const double way = 0.2 / std::cos(angle);
      CHECK(mean == doctest::Approx(std::exp(-params.absorption[c] * way)).epsilon(0.015));
    }
  }
}

TEST_CASE("sun_shadow: a ball's shadow lies opposite to the sun, as dark as its diameter") {
  const Vec3 center(0.3F, 1.0F, -0.2F);
  Points points = spread(200'000, 0.25, [](const Vec3& p) { return p.norm() < 0.25F; });
  points.colwise() += center;
  RenderParams params = fine();
  params.sun_direction = {3, 3, 0};
  const SunShadow map = sun_shadow(points, params);
  // On the floor y = 0 the middle is one height farther along -x; across the rays it is round.
  const Vec3 middle(-0.7F, 0, -0.2F);
  CHECK(at(map, middle, 0) == doctest::Approx(std::exp(-4 * 0.5)).epsilon(0.08));
  CHECK(at(map, middle + Vec3(0, 0, 0.15F), 0) ==
        doctest::Approx(std::exp(-4 * 0.4)).epsilon(0.08));
  CHECK(at(map, middle + Vec3(0.15F * std::sqrt(2.0F), 0, 0), 0) ==
        doctest::Approx(std::exp(-4 * 0.4)).epsilon(0.08));
  CHECK(at(map, middle + Vec3(0, 0, 0.32F), 0) > 0.99);
  CHECK(at(map, middle, 2) == 1);  // nothing absorbs blue
  // White along the border, so that the texture can be clamped there.
  for (int x = 0; x < map.width; ++x)
    CHECK(map.transmittance[4 * static_cast<std::size_t>(x)] == 255);
}

TEST_CASE("sun_shadow: in the picture it lies in a rectangle that is little larger") {
  Points points = spread(200'000, 0.25, [](const Vec3& p) { return p.norm() < 0.25F; });
  points.colwise() += Vec3(0.3F, 1.0F, -0.2F);
  RenderParams params = fine();
  params.sun_direction = {3, 3, 0};
  Camera camera;  // from above: 100 pixels are a meter, x to the right and -z up
  camera.eye = {0, 3, 0};
  camera.up = {0, 0, -1};
  camera.orthographic = true;
  camera.height = 4;
  const SunShadow map = sun_shadow(points, params);
  const Rectangle seen = shadow_rectangle(map, camera, environment_of(params, camera), 600, 400);
  // The middle is at x = -0.7, z = -0.2; the ball's outline is stretched along x.
  const double half_x = 0.25 * std::sqrt(2.0);
  const auto is_outside_by = [](double edge, int value) {
    CHECK(value <= edge);
    CHECK(value >= edge - 30);  // the Gaussian and its margin, 14 texels of 1 cm, and slanted
  };
  is_outside_by(300 + 100 * (-0.7 - half_x), seen.x0);
  is_outside_by(-(300 + 100 * (-0.7 + half_x)), -seen.x1);
  is_outside_by(200 + 100 * (0.2 - 0.25), seen.y0);
  is_outside_by(-(200 + 100 * (0.2 + 0.25)), -seen.y1);
  // With a corner behind the eye it may be anywhere; without shadow it is nowhere.
  camera.orthographic = false;
  camera.eye = {-0.7F, 0.5F, -0.2F};
  camera.target = {5, 0.4F, -0.2F};
  camera.up = {0, 1, 0};
  const Rectangle all = shadow_rectangle(map, camera, environment_of(params, camera), 600, 400);
  CHECK((all.x0 == 0 && all.y0 == 0 && all.x1 == 600 && all.y1 == 400));
  const Rectangle none =
      shadow_rectangle(SunShadow{}, camera, environment_of(params, camera), 600, 400);
  CHECK((none.x0 == none.x1 && none.y0 == none.y1));
}

TEST_CASE("sun_shadow: a particle that flew off does not coarsen the picture") {
  Points points = spread(200'000, 0.25, [](const Vec3&) { return true; });
  const SunShadow before = sun_shadow(points, fine());
  points.conservativeResize(3, points.cols() + 1);
  points.col(points.cols() - 1) << 1e6F, 1e6F, 0;
  const SunShadow after = sun_shadow(points, fine());
  CHECK(after.width <= 2 * before.width);
  CHECK(at(after, {0, 0, 0}, 0) == doctest::Approx(at(before, {0, 0, 0}, 0)).epsilon(0.05));
}

TEST_CASE("sun_shadow: what is too far away for its numbers casts none") {
  Points points = spread(20'000, 0.25, [](const Vec3&) { return true; });
  const SunShadow before = sun_shadow(points, fine());
  Points corners(3, 3);
  corners << 3e38F, -3e38F, 3e38F, 3e38F, 3e38F, -3e38F, -3e38F, 3e38F, 3e38F;
  const auto mesh = std::make_shared<Mesh>(corners, std::vector<Mesh::Triangle>{{0, 1, 2}},
                                           Vec3(Vec3::Constant(0.5F)));
  CHECK(sun_shadow(points, fine(), {mesh}).transmittance == before.transmittance);
  points.conservativeResize(3, points.cols() + 1);
  points.col(points.cols() - 1) = Vec3::Constant(3e38F);
  CHECK(sun_shadow(points, fine()).width <= 2 * before.width);
  CHECK(sun_shadow(Vec3(Vec3::Constant(3e38F)), fine()).width > 1);
}

TEST_CASE("sun_shadow: none without fluid, floor, strength, or with the sun below the floor") {
  const Points points = Points::Zero(3, 1);
  const auto is_white = [](const SunShadow& map) {
    return map.width == 1 && map.height == 1 && map.transmittance[0] == 255;
  };
  CHECK(!is_white(sun_shadow(points, fine())));
  CHECK(is_white(sun_shadow(Points(3, 0), fine())));
  RenderParams params = fine();
  params.floor = false;
  CHECK(is_white(sun_shadow(points, params)));
  params = fine();
  params.shadow = 0;
  CHECK(is_white(sun_shadow(points, params)));
  params = fine();
  params.sun_direction = {1, -0.1F, 0};
  CHECK(is_white(sun_shadow(points, params)));
}
