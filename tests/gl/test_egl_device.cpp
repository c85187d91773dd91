#include "pbf/core/error.hpp"
#include "pbf/gl/egl_device.hpp"

#include <doctest/doctest.h>

#include <cstdlib>
#include <string>
#include <vector>

using namespace pbf;
using Kind = DeviceWish::Kind;

namespace {

/// A server: an integrated GPU, two of CUDA in another order than CUDA's, and software at the end.
std::vector<EglDevice> server() {
  return {{.index = 0, .name = "integrated"},
          {.index = 1, .cuda = 1, .name = "second"},
          {.index = 2, .cuda = 0, .name = "first"},
          {.index = 3, .software = true, .name = "software"}};
}

std::string order(const DeviceWish& wish) {
  std::string names;
  for (const EglDevice& device : ranked(server(), wish)) {
    names += (names.empty() ? "" : " ") + device.name;
  }
  return names;
}

}  // namespace

TEST_CASE("egl_device: GPUs in the order of CUDA, other hardware, software") {
  CHECK(order({}) == "first second integrated software");
}

TEST_CASE("egl_device: a wish leaves what it names") {
  CHECK(order({.kind = Kind::hardware}) == "first second integrated");
  CHECK(order({.kind = Kind::software}) == "software");
  CHECK(order({.kind = Kind::index, .number = 1}) == "second");
  CHECK(order({.kind = Kind::cuda, .number = 1}) == "second");
  CHECK(order({.kind = Kind::cuda, .number = 2}).empty());
  CHECK(order({.kind = Kind::index, .number = 4}).empty());
  CHECK(order({.kind = Kind::surfaceless}).empty());
}

TEST_CASE("device_wish: an argument goes before PBF_EGL_DEVICE, and both before no wish") {
  const char* before = std::getenv("PBF_EGL_DEVICE");
  const std::string kept = before != nullptr ? before : "";
  setenv("PBF_EGL_DEVICE", "cuda:3", 1);
  CHECK(device_wish("").kind == Kind::cuda);
  CHECK(device_wish("").number == 3);
  CHECK(device_wish("").source == "PBF_EGL_DEVICE = cuda:3");
  CHECK(device_wish("2").kind == Kind::index);
  CHECK(device_wish("2").number == 2);
  CHECK(device_wish("2").source == "device = 2");
  CHECK(device_wish("hardware").kind == Kind::hardware);
  CHECK(device_wish("software").kind == Kind::software);
  CHECK(device_wish("surfaceless").kind == Kind::surfaceless);
  setenv("PBF_EGL_DEVICE", "", 1);
  CHECK(device_wish("").kind == Kind::any);
  CHECK(device_wish("").source.empty());
  if (before != nullptr) {
    setenv("PBF_EGL_DEVICE", kept.c_str(), 1);
  } else {
    unsetenv("PBF_EGL_DEVICE");
  }
}

TEST_CASE("device_wish: what means nothing is refused") {
  for (const char* text : {"-1", "1.5", "first", "cuda", "cuda:", "cuda:-1", " 1", "1 ", "0x1",
                           "99999999999999999999", "Software"}) {
    CAPTURE(text);
    CHECK_THROWS_AS(device_wish(text), InvalidParameter);
  }
}
