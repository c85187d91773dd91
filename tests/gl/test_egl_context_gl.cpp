#include "pbf/core/error.hpp"
#include "pbf/gl/egl_context.hpp"
#include "pbf/gl/functions.hpp"
#include "pbf/render/fluid_renderer.hpp"

#include <doctest/doctest.h>

#include <array>
#include <limits>
#include <string>
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

TEST_CASE("egl_context: another program's context, surface and API come back, after errors too") {
  const EglContext ours;
  // Somebody else in this process: OpenGL ES with a surface, on the same display.
  EGLDisplay display = nullptr;
  {
    const auto current = ours.make_current();
    display = eglGetCurrentDisplay();
  }
  constexpr EGLenum kEsApi = 0x30A0;
  eglBindAPI(kEsApi);
  const std::array<EGLint, 5> wanted{EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE,
                                     0x0004 /* ES 2 */, EGL_NONE};
  EGLConfig config = nullptr;
  EGLint count = 0;
  REQUIRE(eglChooseConfig(display, wanted.data(), &config, 1, &count) != 0);
  REQUIRE(count == 1);
  const std::array<EGLint, 3> version{EGL_CONTEXT_MAJOR_VERSION, 2, EGL_NONE};
  const std::array<EGLint, 5> size{EGL_WIDTH, 8, EGL_HEIGHT, 8, EGL_NONE};
  EGLContext theirs = eglCreateContext(display, config, nullptr, version.data());
  EGLSurface draw = eglCreatePbufferSurface(display, config, size.data());
  EGLSurface read = eglCreatePbufferSurface(display, config, size.data());
  REQUIRE(eglMakeCurrent(display, draw, read, theirs) != 0);
  const auto is_theirs = [&] {
    return eglQueryAPI() == kEsApi && eglGetCurrentContext() == theirs &&
           eglGetCurrentDisplay() == display && eglGetCurrentSurface(EGL_DRAW) == draw &&
           eglGetCurrentSurface(EGL_READ) == read;
  };
  REQUIRE(is_theirs());
  {
    const auto current = ours.make_current();
    CHECK(eglGetCurrentContext() != theirs);
    CHECK(eglQueryAPI() == EGL_OPENGL_API);
  }
  CHECK(is_theirs());
  {
    FluidRenderer renderer(16, 16);
    CHECK(is_theirs());
    renderer.render(Points::Zero(3, 1), Camera{}, RenderParams{});
    CHECK(is_theirs());
    CHECK_THROWS_AS(FluidRenderer(16, 1 << 24), InvalidParameter);
    CHECK(is_theirs());
    CHECK_THROWS_AS(EglContext("index"), InvalidParameter);
  }
  CHECK(is_theirs());
  CHECK(eglGetError() == EGL_SUCCESS);
  eglMakeCurrent(display, nullptr, nullptr, nullptr);
  eglDestroySurface(display, draw);
  eglDestroySurface(display, read);
  eglDestroyContext(display, theirs);
  eglBindAPI(EGL_OPENGL_API);
}

TEST_CASE("egl_context: a second thread at the same time gets an error in words") {
  const EglContext context;
  const auto current = context.make_current();
  std::string message;
  std::thread([&] {
    try {
      const auto second = context.make_current();
    } catch (const GlError& error) {
      message = error.what();
    }
    CHECK(eglGetCurrentContext() == nullptr);
  }).join();
  CHECK(message.find("EGL_BAD_ACCESS: the context is current in another thread") !=
        std::string::npos);
}

TEST_CASE("egl_context: says what it draws with and why") {
  const EglContext any;
  CHECK_FALSE(any.info().choice.empty());
  const EglContext asked("0");
  CHECK(asked.info().choice == "asked for by device = 0");
  CHECK(asked.info().asked_for);
  CHECK(asked.info().attempts.empty());
  if (asked.info().renderer.find("llvmpipe") != std::string::npos) CHECK(asked.info().software);
  CHECK_THROWS_WITH_AS(EglContext("99"), doctest::Contains("\n  EGL device 0 ("),
                       RendererUnavailable);
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
