#include "pbf/render/passes/curvature_flow.hpp"
#include "pbf/render/raster/curvature_flow.hpp"

#include "filter_fixture.hpp"
#include "instruction_sets.hpp"

using namespace pbf;
using namespace pbf::test;

namespace {

LayerFilter flow_of(Real radius, Real range = 0.2F) {
  return {LayerFilter::Layer::depth, Smoothing::curvature_flow, radius, range, 0};
}

std::vector<float> flow_in_cpp(const GlFixture& gl,
                               const LayerFilter& filter,
                               const FlowSchedule& schedule,
                               const Function& depth,
                               const Function& sphere,
                               int threads = 0) {
  raster::Map a = map_of(gl, depth), b = map_of(gl, depth), c = map_of(gl, depth);
  raster::curvature_flow(filter, schedule, gl.frame(), all_tiles(gl), map_of(gl, depth),
                         map_of(gl, sphere), {&a, &b, &c}, threads);
  return numbers_of(gl, a);
}

std::vector<float> flow_in_glsl(const GlFixture& gl,
                                const LayerFilter& filter,
                                const FlowSchedule& schedule,
                                const Function& depth,
                                const Function& sphere) {
  const CurvatureFlow pass(glsl_source);
  const Target a(gl.width(), gl.height(), Format::r32f), b(gl.width(), gl.height(), Format::r32f),
      c(gl.width(), gl.height(), Format::r32f);
  pass(filter, schedule, gl.tiles(), gl.texture(depth), gl.texture(sphere), {&a, &b, &c});
  return gl.read(a.texture);
}

std::vector<float> flow(
    Way way,
    const GlFixture& gl,
    const LayerFilter& filter,
    const FlowSchedule& schedule,
    const Function& depth,
    const Function& sphere = [](int, int) { return with_level(0.5, 0); }) {
  return way == Way::glsl ? flow_in_glsl(gl, filter, schedule, depth, sphere)
                          : flow_in_cpp(gl, filter, schedule, depth, sphere);
}

std::vector<Camera> cameras() {
  std::vector<Camera> result{parallel(2)};
  for (const Real fov : {20.0F, 60.0F, 90.0F}) {
    result.push_back(GlFixture::looking_down_z());
    result.back().fov_y = fov;
  }
  return result;
}

double legendre(int n, double x) {
  double last = 1, result = x;
  for (int k = 2; k <= n; ++k) {
    last = std::exchange(result, ((2 * k - 1) * x * result - (k - 1) * last) / k);
  }
  return result;
}

}  // namespace

TEST_CASE("curvature_flow: a tilted plane rests, at the border and around a hole too") {
  for (const Camera& camera : cameras()) {
    const GlFixture gl(64, 48, camera);
    const auto plane = [&](int x, int y) {
      const double tilt = 0.3 * gl.slope_x(x) - 0.2 * gl.slope_y(y);
      return camera.orthographic ? 2 + tilt : 2 / (1 - tilt);
    };
    const auto affine = [&](double d) { return camera.orthographic ? -d : 1 / d; };
    const auto hole = [](int x, int y) { return std::hypot(x - 50, y - 8) < 5; };
    const Real pixel = 2 * camera.half_height() / 48 * (camera.orthographic ? 1.0F : 2.0F);
    const LayerFilter filter = flow_of(6 * pixel);
    const FlowSchedule schedule = flow_schedule(filter, 2, gl.frame(), 2);
    for (const Way way : kWays) {
      const auto result = flow(way, gl, filter, schedule, [&](int x, int y) {
        return hole(x, y) ? double{kNothing} : affine(plane(x, y));
      });
      double worst = 0;
      for (int y = 0; y < gl.height(); ++y) {
        for (int x = 0; x < gl.width(); ++x) {
          if (hole(x, y)) {
            CHECK(result[gl.at(x, y)] == kNothing);
          } else {
            worst = std::max(worst, std::abs(affine(result[gl.at(x, y)]) / plane(x, y) - 1));
          }
        }
      }
      CAPTURE(camera.orthographic);
      CAPTURE(camera.fov_y);
      CHECK(worst < 1e-5);  // rounding of float32, stage by stage
    }
  }
}

TEST_CASE("curvature_flow: a sphere shrinks as r^2 = r0^2 - 4 D T, for any camera") {
  const double r0 = 0.5, sigma = 0.1;
  const int iterations = 2;
  const double r = std::sqrt(r0 * r0 - 4 * iterations * 0.5 * sigma * sigma);
  const LayerFilter filter = flow_of(static_cast<Real>(2 * sigma), 0.1F);
  for (const Camera& camera : cameras()) {
    const GlFixture gl(160, 120, camera);
    const double half = camera.half_height();
    // In perspective as far away as makes it the same size in each picture, and off the axis.
    const double distance = camera.orthographic ? 3 : 1.0 / half;
    const double cx = 0.5, cy = -0.3;
    const auto front = [&](double radius, int x, int y) {
      const double sx = gl.slope_x(x), sy = gl.slope_y(y);
      const double length2 = camera.orthographic ? 1 : sx * sx + sy * sy + 1;
      const double middle =
          camera.orthographic ? distance : (sx * cx + sy * cy + distance) / length2;
      const double mx = camera.orthographic ? cx - sx : cx - middle * sx;
      const double my = camera.orthographic ? cy - sy : cy - middle * sy;
      const double mz = distance - middle;
      const double half2 = radius * radius - mx * mx - my * my - mz * mz;
      return half2 < 0 ? 0 : middle - std::sqrt(half2 / length2);
    };
    const auto affine = [&](double d) { return camera.orthographic ? -d : 1 / d; };
    const FlowSchedule schedule =
        flow_schedule(filter, iterations, gl.frame(), static_cast<Real>(distance - r0));
    for (const Way way : kWays) {
      const auto result = flow(way, gl, filter, schedule, [&](int x, int y) {
        const double d = front(r0, x, y);
        return d == 0 ? double{kNothing} : affine(d);
      });
      double worst = 0;
      int count = 0;
      for (int y = 0; y < gl.height(); ++y) {
        for (int x = 0; x < gl.width(); ++x) {
          if (front(0.5 * r, x, y) == 0) continue;  // away from the outline
          ++count;
          worst = std::max(worst, std::abs(affine(result[gl.at(x, y)]) - front(r, x, y)));
        }
      }
      CAPTURE(camera.orthographic);
      CAPTURE(camera.fov_y);
      CHECK(count > 150);
      CHECK(worst < 0.03 * (r0 - r));
    }
  }
}

TEST_CASE("curvature_flow: a wave decays as the scheme's polynomial says, close to a Gaussian's") {
  const GlFixture gl(96, 96, parallel(9.6F));  // a pixel is 0.1 m
  const LayerFilter filter = flow_of(0.8F);    // standard deviation 4 pixels
  const FlowSchedule schedule = flow_schedule(filter, 1, gl.frame(), 1);
  for (const int length : {8, 16, 32}) {
    const double k = 2 * std::numbers::pi / length;
    // So flat that a slope has no say.
    const auto wave = [&](int x, int) { return -2 + 1e-3 * std::cos(k * (x - 48)); };
    const double laplacian = 2 - 2 * std::cos(k);
    const double far = 0.5 * (schedule.stages * schedule.stages + schedule.stages);
    const double damped = std::pow(
        legendre(schedule.stages, 1 - schedule.variance * 100 * laplacian / far), schedule.steps);
    CHECK(std::abs(damped - std::exp(-0.5 * 16 * k * k)) < 0.05);
    for (const Way way : kWays) {
      const auto result = flow(way, gl, filter, schedule, wave);
      CAPTURE(length);
      CHECK((result[gl.at(48, 40)] + 2) / 1e-3 == doctest::Approx(damped).epsilon(0.02).scale(0.1));
    }
  }
}

TEST_CASE("curvature_flow: a step higher than the range and a drop stay as they are") {
  const GlFixture gl;
  const LayerFilter filter = flow_of(0.2F);
  const FlowSchedule schedule = flow_schedule(filter, 2, gl.frame(), 2);
  const auto step = [](int x, int) { return 1 / (x < 32 ? 2.0 : 2.201); };
  const auto bump = [](int x, int y) {
    return 1 / (2 - 0.05 * std::exp(-0.02 * ((x - 32) * (x - 32) + (y - 24) * (y - 24))));
  };
  const auto level = [](std::uint32_t n) { return [n](int, int) { return with_level(0.5, n); }; };
  for (const Way way : kWays) {
    const auto kept = flow(way, gl, filter, schedule, step);
    for (int x = 0; x < gl.width(); ++x) {
      CHECK(kept[gl.at(x, 24)] == doctest::Approx(step(x, 0)).epsilon(1e-6));
    }
    double last = 2 - 0.05;
    for (const std::uint32_t n : {3U, 2U, 1U, 0U}) {
      const double peak = 1 / flow(way, gl, filter, schedule, bump, level(n))[gl.at(32, 24)];
      if (n == 3)
        CHECK(peak == doctest::Approx(last).epsilon(1e-6));
      else
        CHECK(peak > last + 1e-4);
      last = peak;
    }
  }
}

TEST_CASE("curvature_flow: the same from twice the distance with twice the resolution") {
  const auto peak = [](Way way, int width, int height, double depth) {
    const GlFixture gl(width, height);
    const double pixel = 2 * std::tan(std::numbers::pi / 6) * depth / height;
    const LayerFilter filter = flow_of(0.3F);
    const auto bump = [&](int x, int y) {
      const double r = std::hypot(x + 0.5 - width / 2.0, y + 0.5 - height / 2.0) * pixel;
      return 1 / (depth - 0.1 * std::exp(-r * r / 0.02));
    };
    const FlowSchedule schedule = flow_schedule(filter, 2, gl.frame(), static_cast<Real>(depth));
    return depth - 1 / flow(way, gl, filter, schedule, bump)[gl.at(width / 2, height / 2)];
  };
  for (const Way way : kWays) {
    CHECK(peak(way, 128, 96, 2) == doctest::Approx(peak(way, 256, 192, 4)).epsilon(0.05));
    CHECK(peak(way, 128, 96, 2) == doctest::Approx(peak(way, 256, 192, 2)).epsilon(0.05));
  }
}

TEST_CASE("curvature_flow: C++ and GLSL give the same numbers, C++ the same bits for any threads") {
  for (const double near : {0.6, 1.5}) {
    const GlFixture gl(203, 101);
    const Rough rough{gl, near};
    const auto sphere = [&](int x, int y) { return rough.sphere(x, y); };
    const LayerFilter filter = flow_of(0.06F);
    const FlowSchedule schedule = flow_schedule(filter, 2, gl.frame(), static_cast<Real>(near));
    const auto glsl = flow(Way::glsl, gl, filter, schedule, sphere, sphere);
    const auto cpp = flow_in_cpp(gl, filter, schedule, sphere, sphere, 1);
    double worst = 0;
    for (std::size_t k = 0; k < glsl.size(); ++k) {
      worst = std::max<double>(worst, std::abs(cpp[k] / glsl[k] - 1.0));
    }
    CHECK(worst < 3e-5);
    CHECK(flow_in_cpp(gl, filter, schedule, sphere, sphere, 3) == cpp);
    for_each_isa([&] { CHECK(flow_in_cpp(gl, filter, schedule, sphere, sphere, 2) == cpp); });
  }
}

TEST_CASE("curvature_flow: more stages for smaller pixels, and stable where they are not enough") {
  const LayerFilter filter = flow_of(0.2F);
  int last = 0;
  for (const int size : {24, 48, 96, 192}) {
    const GlFixture gl(size, size);
    const FlowSchedule schedule = flow_schedule(filter, 2, gl.frame(), 2);
    CHECK(schedule.stages > last);
    last = schedule.stages;
    // Half of them: no pixel may leave the range that it began in.
    const FlowSchedule short_of{schedule.steps, (schedule.stages + 1) / 2, schedule.variance};
    const auto rough = [](int x, int y) { return 0.5 + 0.01 * ((x * 7 + y * 13) % 5); };
    for (const Way way : kWays) {
      const auto result = flow(way, gl, filter, short_of, rough);
      const auto [low, high] = std::minmax_element(result.begin(), result.end());
      CHECK(*low > 0.499);
      CHECK(*high < 0.541);
    }
  }
}
