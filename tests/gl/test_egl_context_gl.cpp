#include "pbf/core/error.hpp"
#include "pbf/gl/egl_context.hpp"
#include "pbf/gl/functions.hpp"
#include "pbf/render/fluid_renderer.hpp"

#include <doctest/doctest.h>

#include <limits>
#include <thread>
#include <vector>

using namespace pbf;

TEST_CASE("egl_context: is current only while asked for, and gives back what was before") {
  const EglContext one;
  const EglContext two;
  CHECK(eglGetCurrentContext() == nullptr);
  {
    const auto first = one.make_current();
    EGLContext const outer = eglGetCurrentContext();
    CHECK(outer != nullptr);
    {
      const auto second = two.make_current();
      CHECK(eglGetCurrentContext() != outer);
    }
    CHECK(eglGetCurrentContext() == outer);
  }
  CHECK(eglGetCurrentContext() == nullptr);
  CHECK(one.info().major * 10 + one.info().minor >= 33);
}

TEST_CASE("fluid_renderer: several in several threads draw the same picture") {
  const Points cloud = Points::Random(3, 200);
  RenderParams params;
  params.radius = 0.1F;
  const auto draw = [&] {
    FluidRenderer renderer(64, 48);
    return renderer.render(cloud, Camera{}, params).data;
  };
  const auto expected = draw();
  std::vector<std::vector<std::uint8_t>> results(3);
  std::vector<std::thread> threads;
  for (auto& result : results) threads.emplace_back([&] { result = draw(); });
  for (auto& thread : threads) thread.join();
  for (const auto& result : results) CHECK(result == expected);
}

TEST_CASE("fluid_renderer: refuses what is not finite and sizes that cannot be") {
  FluidRenderer renderer(16, 16);
  Points cloud = Points::Zero(3, 4);
  cloud(1, 2) = std::numeric_limits<Real>::quiet_NaN();
  CHECK_THROWS_WITH_AS(renderer.render(cloud, Camera{}, RenderParams{}),
                       "positions: particle 2 is not finite; every coordinate must be",
                       InvalidParameter);
  CHECK_THROWS_AS(FluidRenderer(0, 16), InvalidParameter);
  CHECK_THROWS_AS(FluidRenderer(16, 1 << 24), InvalidParameter);
}
