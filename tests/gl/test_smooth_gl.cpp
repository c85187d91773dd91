#include "pbf/render/passes/smooth.hpp"
#include "pbf/render/raster/smooth.hpp"

#include "filter_fixture.hpp"
#include "instruction_sets.hpp"

using namespace pbf;
using namespace pbf::test;

namespace {

constexpr Smoothing kSeparable[] = {Smoothing::bilateral, Smoothing::gaussian,
                                    Smoothing::narrow_range};

constexpr double kHere = 2.0;  // depth of most surfaces here [m]

using Layer = LayerFilter::Layer;

LayerFilter depth_of(Smoothing kind, Real radius = 0.2F, Real range = 0.1F, Real behind = 0.05F) {
  return {Layer::depth, kind, radius, range, behind};
}
LayerFilter thickness_of(Smoothing kind) { return {Layer::thickness, kind, 0.2F, 0.1F, 0}; }

std::vector<float> smooth_in_glsl(const GlFixture& gl,
                                  const LayerFilter& filter,
                                  const Function& value,
                                  const Function& sphere) {
  const Smooth pass(glsl_source);
  const Texture between(gl.width(), gl.height(), Format::r32f);
  const Texture result(gl.width(), gl.height(), Format::r32f);
  pass(filter, gl.tiles(), gl.texture(value), gl.texture(sphere), Framebuffer({&between}), between,
       Framebuffer({&result}));
  return gl.read(result);
}

std::vector<float> smooth_in_cpp(const GlFixture& gl,
                                 const LayerFilter& filter,
                                 const Function& value,
                                 const Function& sphere,
                                 int threads = 0) {
  raster::Map between(gl.width(), gl.height(), kNothing);
  raster::Map out(gl.width(), gl.height(), kNothing);
  raster::smooth(filter, gl.frame(), all_tiles(gl), map_of(gl, value), map_of(gl, sphere), between,
                 out, threads);
  return numbers_of(gl, out);
}

std::vector<float> smooth(
    Way way,
    const GlFixture& gl,
    const LayerFilter& filter,
    const Function& value,
    const Function& sphere = [](int, int) { return with_level(0.5, 0); }) {
  // Fronts carry the crowding of their spheres.
  const auto front = [&](int x, int y) {
    const double a = value(x, y);
    return a == kNothing ? a : with_level(a, level_of(sphere(x, y)));
  };
  const Function& layer = filter.layer == Layer::depth ? Function(front) : value;
  return way == Way::glsl ? smooth_in_glsl(gl, filter, layer, sphere)
                          : smooth_in_cpp(gl, filter, layer, sphere);
}

}  // namespace

TEST_CASE("smooth: a constant stays constant, at the border and around a hole too") {
  const GlFixture gl;
  const auto hole = [](int x, int y) { return std::hypot(x - 30, y - 20) < 6; };
  for (const Way way : kWays) {
    for (const Smoothing kind : kSeparable) {
      const std::vector<float> result = smooth(way, gl, depth_of(kind), [&](int x, int y) {
        return hole(x, y) ? double{kNothing} : 1 / kHere;
      });
      for (int y = 0; y < gl.height(); ++y) {
        for (int x = 0; x < gl.width(); ++x) {
          CHECK(result[gl.at(x, y)] == (hole(x, y) ? kNothing : 0.5F));
        }
      }
    }
  }
}

TEST_CASE("smooth: a tilted plane stays that plane, at the border and around a hole too") {
  std::vector<Camera> cameras{parallel(2)};
  for (const Real fov : {20.0F, 60.0F, 90.0F}) {
    cameras.push_back(GlFixture::looking_down_z());
    cameras.back().fov_y = fov;
  }
  for (const Camera& camera : cameras) {
    const GlFixture gl(64, 48, camera);
    // Depth d of the plane d = 2 + 0.3 x - 0.2 y, hit by the pixel's ray. No step between pixels is
    // higher than the range of 0.2 m.
    const auto plane = [&](int x, int y) {
      const double tilt = 0.3 * gl.slope_x(x) - 0.2 * gl.slope_y(y);
      return camera.orthographic ? kHere + tilt : kHere / (1 - tilt);
    };
    const auto affine = [&](double d) { return camera.orthographic ? -d : 1 / d; };
    const auto hole = [](int x, int y) { return std::hypot(x - 50, y - 8) < 5; };
    const Real radius = 8 * camera.half_height() * (camera.orthographic ? 1.0F : 2.0F) / 24;
    for (const Way way : kWays) {
      for (const Smoothing kind : kSeparable) {
        const std::vector<float> result = smooth(
            way, gl, depth_of(kind, radius, 0.2F),
            [&](int x, int y) { return hole(x, y) ? double{kNothing} : affine(plane(x, y)); });
        double worst = 0;
        for (int y = 0; y < gl.height(); ++y) {
          for (int x = 0; x < gl.width(); ++x) {
            if (hole(x, y)) continue;
            const double d = affine(result[gl.at(x, y)]);
            worst = std::max(worst, std::abs(d / plane(x, y) - 1));
          }
        }
        CAPTURE(camera.orthographic);
        CAPTURE(camera.fov_y);
        CAPTURE(static_cast<int>(kind));
        CHECK(worst < 2e-6);  // rounding of float32
      }
    }
  }
}

TEST_CASE("smooth: a step higher than the range is kept by bilateral and spread by gaussian") {
  const GlFixture gl;
  const auto step = [](int x, int) { return 1 / (x < 32 ? kHere : kHere + 0.101); };
  for (const Way way : kWays) {
    const auto kept = smooth(way, gl, depth_of(Smoothing::bilateral), step);
    const auto spread = smooth(way, gl, depth_of(Smoothing::gaussian), step);
    for (int x = 0; x < gl.width(); ++x) {
      CHECK(kept[gl.at(x, 24)] == static_cast<float>(step(x, 0)));
    }
    CHECK(1 / spread[gl.at(31, 24)] > kHere + 0.02);
    CHECK(1 / spread[gl.at(32, 24)] < kHere + 0.08);
  }
}

TEST_CASE("smooth: of far sides, what ends before a pixel's front is another body's") {
  const GlFixture gl;
  LayerFilter filter = depth_of(Smoothing::gaussian);
  filter.layer = Layer::far_side;
  // On the left a drop well before the body on the right.
  const auto far_side = [](int x, int) { return 1 / (x < 30 ? 0.5 * kHere : kHere); };
  const auto front = [](int x, int) {
    return with_level(1 / (x < 30 ? 0.4 * kHere : 0.9 * kHere), 0);
  };
  for (const Way way : kWays) {
    const std::vector<float> result = smooth(way, gl, filter, far_side, front);
    for (int x = 30; x < gl.width(); ++x) CHECK(result[gl.at(x, 20)] == 0.5F);
    // What is behind goes over into the drop's.
    CHECK(result[gl.at(29, 20)] > 0.6F);
    CHECK(result[gl.at(29, 20)] < 0.9F);
  }
}

TEST_CASE("smooth: the answer to an impulse is the kernel, whose width is a length in the scene") {
  const GlFixture gl(64, 48, parallel(4.8F));  // a pixel is 0.1 m
  const double radius = 5.5;                   // pixels; the standard deviation is half of it
  const auto weight = [&](int k) {
    const double fade = std::clamp(radius + 1 - std::abs(k), 0.0, 1.0);
    return std::exp(-0.5 * k * k / (0.25 * radius * radius)) * fade;
  };
  double total = 0;
  for (int k = -6; k <= 6; ++k) total += weight(k);
  for (const Way way : kWays) {
    const auto result =
        smooth(way, gl, depth_of(Smoothing::gaussian, static_cast<Real>(0.1 * radius)),
               [](int x, int y) { return x == 32 && y == 24 ? -1.0 : -2.0; });
    for (int dy = -8; dy <= 8; ++dy) {
      for (int dx = -8; dx <= 8; ++dx) {
        // Symmetric neighbors: the fitted line's value in the middle is the weighted mean.
        const double expected = weight(dx) * weight(dy) / (total * total);
        CHECK(result[gl.at(32 + dx, 24 + dy)] + 2 ==
              doctest::Approx(expected).epsilon(1e-4).scale(0.01));
      }
    }
  }
}

TEST_CASE(
    "smooth: narrow_range rounds off the edge of what is in front, by the length it was given") {
  const GlFixture gl(64, 48, parallel(4.8F));  // a pixel is 0.1 m
  const double radius = 5.5, behind = 0.25;
  const auto weight = [&](int k) {
    const double fade = std::clamp(radius + 1 - std::abs(k), 0.0, 1.0);
    return std::exp(-0.5 * k * k / (0.25 * radius * radius)) * fade;
  };
  double total = 0;
  for (int k = -6; k <= 6; ++k) total += weight(k);
  for (const Way way : kWays) {
    const auto result =
        smooth(way, gl, depth_of(Smoothing::narrow_range, 0.55F, 1, static_cast<Real>(behind)),
               [](int x, int) { return x < 32 ? -2.0 : -3.5; });
    for (int x = 0; x < gl.width(); ++x) {
      double beyond = 0;  // weight of the neighbors behind the edge, at x = 32
      for (int k = 1; k <= 6; ++k) beyond += x < 32 && x + k >= 32 ? weight(k) : 0;
      const double expected = x < 32 ? -2 - behind * beyond / total : -3.5;
      CHECK(result[gl.at(x, 24)] == doctest::Approx(expected).epsilon(1e-6));
    }
  }
}

TEST_CASE("smooth: a kernel that is thinned out answers with as smooth a Gaussian in the end") {
  const GlFixture gl(201, 201, parallel(20.1F));  // a pixel is 0.1 m
  // 60 pixels in taps of three; then 1.5 times three pixels in taps of one.
  LayerFilter filter = depth_of(Smoothing::gaussian, 6);
  CHECK(leaves_gaps(filter, gl.frame(), 1));
  CHECK(!leaves_gaps(depth_of(Smoothing::gaussian, 2.39F), gl.frame(), 1));
  const auto impulse = [](int x, int y) { return x == 100 && y == 100 ? 1e3 : -2.0; };
  for (const Way way : kWays) {
    filter.close_gaps = false;
    const auto gaps = smooth(way, gl, filter, impulse);
    CHECK(gaps[gl.at(100, 101)] == -2);
    CHECK(gaps[gl.at(100, 103)] > -1);
    filter.close_gaps = true;
    const auto closed = smooth(way, gl, filter, [&](int x, int y) { return gaps[gl.at(x, y)]; });
    const double peak = closed[gl.at(100, 100)] + 2;
    const double variance = 30 * 30;
    for (int dx = 0; dx <= 40; ++dx) {
      const double expected = peak * std::exp(-0.5 * dx * dx / variance);
      CHECK(closed[gl.at(100 + dx, 100)] + 2 == doctest::Approx(expected).epsilon(0.1));
      CHECK(closed[gl.at(100, 100 + dx)] + 2 == doctest::Approx(expected).epsilon(0.1));
    }
  }
}

TEST_CASE("smooth: narrow_range takes in a slope that the range alone would cut") {
  // A ramp of 0.08 m a pixel over 12 pixels to a side: far more than the range of 0.3 m, but no
  // step between neighbors is.
  const GlFixture gl(64, 48, parallel(4.8F));
  const auto ramp = [](int x, int) { return -3.0 + (x > 40 ? 8.0 * 0.08 : 0.08 * (x - 32)); };
  for (const Way way : kWays) {
    const auto narrow = smooth(way, gl, depth_of(Smoothing::narrow_range, 1.2F, 0.3F, 0.2F), ramp);
    const auto gaussian = smooth(way, gl, depth_of(Smoothing::gaussian, 1.2F), ramp);
    const auto bilateral = smooth(way, gl, depth_of(Smoothing::bilateral, 1.2F, 0.3F), ramp);
    CHECK(narrow[gl.at(40, 24)] == gaussian[gl.at(40, 24)]);
    CHECK(bilateral[gl.at(40, 24)] != doctest::Approx(gaussian[gl.at(40, 24)]).epsilon(1e-4));
  }
}

TEST_CASE("smooth: the kernel shrinks with distance as things do") {
  // The same bump, seen at twice the distance with twice the resolution, is smoothed to the same
  // shape.
  for (const Way way : kWays) {
    const auto peak = [&](int width, int height, double depth) {
      const GlFixture gl(width, height);
      const double pixel = 2 * std::tan(std::numbers::pi / 6) * depth / height;
      const auto bump = [&](int x, int y) {
        const double r = std::hypot(x + 0.5 - width / 2.0, y + 0.5 - height / 2.0) * pixel;
        return 1 / (depth - 0.1 * std::exp(-r * r / 0.02));
      };
      const auto result = smooth(way, gl, depth_of(Smoothing::bilateral, 0.3F, 0.4F), bump);
      return depth - 1 / result[gl.at(width / 2, height / 2)];
    };
    CHECK(peak(64, 48, 2) == doctest::Approx(peak(128, 96, 4)).epsilon(0.3));
    CHECK(peak(128, 96, 2) == doctest::Approx(peak(256, 192, 4)).epsilon(0.05));
  }
}

TEST_CASE("smooth: a drop stays as it is, a kernel is as wide as the square of the crowding") {
  const GlFixture gl;
  const auto bump = [](int x, int y) {
    return 1 / (kHere - 0.05 * std::exp(-0.02 * ((x - 32) * (x - 32) + (y - 24) * (y - 24))));
  };
  for (const Way way : kWays) {
    const auto peak = [&](Real radius, std::uint32_t level) {  // its depth [m]
      const auto result = smooth(way, gl, depth_of(Smoothing::bilateral, radius, 0.4F), bump,
                                 [&](int, int) { return with_level(0.5, level); });
      const auto drop = [&](int x, int y) { return with_level(bump(x, y), 3); };
      if (level == 3) CHECK(result == gl.read(gl.texture(drop)));
      return 1 / result[gl.at(32, 24)];
    };
    double last = peak(0.6F, 3);
    for (const std::uint32_t level : {2U, 1U, 0U}) {
      const Real share = std::pow(1 - static_cast<Real>(level) / 3, 2.0F);
      const double found = peak(0.6F, level);
      CHECK(found > last + 1e-4);
      CHECK(found == doctest::Approx(peak(0.6F * share, 0)).epsilon(1e-6));
      last = found;
    }
  }
}

TEST_CASE("smooth: a body is the same whether a drop is before it or a hole in it") {
  const GlFixture gl;
  const auto at_drop = [](int x, int y) { return std::hypot(x - 30, y - 20) < 4; };
  const auto body = [](int x, int y) { return 1 / (kHere + 0.01 * std::sin(0.7 * x + 0.9 * y)); };
  const auto sphere = [&](int x, int y) { return with_level(0.5, at_drop(x, y) ? 3U : 0U); };
  // Nearer than the surface by less than the range: the window alone would let the drop in.
  const auto with_drop = [&](int x, int y) {
    return at_drop(x, y) ? 1 / (kHere - 0.06) : body(x, y);
  };
  const auto with_hole = [&](int x, int y) {
    return at_drop(x, y) ? double{kNothing} : body(x, y);
  };
  for (const Way way : kWays) {
    for (const Smoothing kind : {Smoothing::bilateral, Smoothing::narrow_range}) {
      const LayerFilter filter = depth_of(kind);
      const auto drop = smooth(way, gl, filter, with_drop, sphere);
      const auto hole = smooth(way, gl, filter, with_hole, sphere);
      double worst = 0;
      for (int y = 0; y < gl.height(); ++y) {
        for (int x = 0; x < gl.width(); ++x) {
          const float found = drop[gl.at(x, y)], expected = hole[gl.at(x, y)];
          if (at_drop(x, y)) {
            CHECK(found == static_cast<float>(with_level(with_drop(x, y), 3)));
            continue;
          }
          worst = std::max<double>(worst, std::abs(found - expected));
          CHECK(level_of(found) == 0);
        }
      }
      CAPTURE(static_cast<int>(kind));
      // A narrow_range neighbor of a drop loses its mirror image as well.
      if (kind == Smoothing::bilateral) CHECK(worst == 0);
      CHECK(worst < 0.25 * 0.01);
    }
  }
}

TEST_CASE("smooth: of thickness a constant stays, and pixels without fluid carry no weight") {
  const GlFixture gl;
  const auto hole = [](int x, int y) { return x > 40 && y > 20; };
  for (const Way way : kWays) {
    for (const Smoothing kind : {Smoothing::bilateral, Smoothing::gaussian}) {
      const auto result = smooth(way, gl, thickness_of(kind),
                                 [&](int x, int y) { return hole(x, y) ? 0.0 : 0.25; });
      for (int y = 0; y < gl.height(); ++y) {
        for (int x = 0; x < gl.width(); ++x) {
          CHECK(result[gl.at(x, y)] == (hole(x, y) ? 0.0F : 0.25F));
        }
      }
    }
  }
}

TEST_CASE("smooth: of thickness a wedge stays, and a high step is kept or spread by name") {
  const GlFixture gl;
  const auto wedge = [](int x, int) { return 0.1 + 0.002 * x; };
  const auto step = [](int x, int) { return x < 32 ? 0.1 : 0.3; };
  for (const Way way : kWays) {
    for (const Smoothing kind : {Smoothing::bilateral, Smoothing::gaussian}) {
      const auto result = smooth(way, gl, thickness_of(kind), wedge);
      for (int x = 0; x < gl.width(); ++x) {
        CHECK(result[gl.at(x, 10)] == doctest::Approx(wedge(x, 10)).epsilon(1e-5));
      }
    }
    CHECK(smooth(way, gl, thickness_of(Smoothing::bilateral), step)[gl.at(31, 10)] == 0.1F);
    CHECK(smooth(way, gl, thickness_of(Smoothing::gaussian), step)[gl.at(31, 10)] > 0.14F);
  }
}

TEST_CASE("smooth: C++ and GLSL give the same numbers, for kernels of 1 to 60 pixels") {
  const GlFixture gl(203, 101);  // no multiple of a tile
  for (const double near : {0.3, 1.0, 4.0}) {
    const Rough rough{gl, near};
    const auto sphere = [&](int x, int y) { return rough.sphere(x, y); };
    for (const Smoothing kind : kSeparable) {
      const LayerFilter filter = depth_of(kind, 0.2F, 0.15F, 0.1F);
      const auto glsl = smooth(Way::glsl, gl, filter, sphere, sphere);
      const auto cpp = smooth(Way::cpp, gl, filter, sphere, sphere);
      int different = 0;
      double worst = 0;
      for (std::size_t k = 0; k < glsl.size(); ++k) {
        const double error = std::abs(cpp[k] / glsl[k] - 1.0);
        // Rounding may decide on which side of the range a neighbor is, or whether every pixel is
        // taken.
        if (error > 1e-5)
          ++different;
        else
          worst = std::max(worst, error);
      }
      CAPTURE(near);
      CAPTURE(static_cast<int>(kind));
      CHECK(different < 20);
      CHECK(worst < 1e-5);
    }
    for (const Smoothing kind : {Smoothing::bilateral, Smoothing::gaussian}) {
      const auto thickness = [](int x, int y) {
        return x % 37 == 3 ? 0 : 0.1 + 0.05 * std::sin(x * y);
      };
      const auto glsl = smooth(Way::glsl, gl, thickness_of(kind), thickness, sphere);
      const auto cpp = smooth(Way::cpp, gl, thickness_of(kind), thickness, sphere);
      double worst = 0;
      for (std::size_t k = 0; k < glsl.size(); ++k) {
        worst = std::max<double>(worst, std::abs(cpp[k] - glsl[k]));
      }
      CHECK(worst < 2e-6);
    }
  }
}

TEST_CASE("smooth: C++ has the same bits for any number of threads and any instruction set") {
  const GlFixture gl(203, 101);
  const Rough rough{gl, 0.5};
  const auto sphere = [&](int x, int y) { return rough.sphere(x, y); };
  for (const Smoothing kind : kSeparable) {
    const LayerFilter filter = depth_of(kind, 0.2F, 0.15F, 0.1F);
    const auto once = smooth_in_cpp(gl, filter, sphere, sphere, 1);
    for (const int threads : {2, 3, 7}) {
      CHECK(smooth_in_cpp(gl, filter, sphere, sphere, threads) == once);
    }
    for_each_isa([&] { CHECK(smooth_in_cpp(gl, filter, sphere, sphere, 1) == once); });
  }
}
