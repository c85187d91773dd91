#include "pbf/core/isa.hpp"
#include "pbf/render/cpu_renderer.hpp"

#include <doctest/doctest.h>

#include "instruction_sets.hpp"
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

using namespace pbf;
using test::for_each_isa;

namespace {

/// A pool with a hump, drops above it, and two that have flown off.
Points pool() {
  std::vector<Vec3> x;
  for (int k = 0; k < 16 * 8 * 10; ++k) {
    const Vec3 at = 0.05F * Vec3(static_cast<Real>(k % 16), static_cast<Real>(k / 160),
                                 static_cast<Real>(k / 16 % 10));
    if (at.y() < 0.2F + 0.15F * std::sin(8 * at.x())) x.push_back(at);
  }
  for (int k = 0; k < 20; ++k) {
    const auto angle = static_cast<Real>(k);
    x.emplace_back(0.4F + 0.3F * std::cos(angle), 0.5F + 0.01F * angle, 0.25F * std::sin(angle));
  }
  x.emplace_back(1e6F, 3, 0);
  x.emplace_back(0, -1e30F, 0);
  Points points(3, static_cast<Index>(x.size()));
  for (Index i = 0; i < points.cols(); ++i) points.col(i) = x[static_cast<std::size_t>(i)];
  return points;
}

Meshes board() {
  const Points corners{{-0.2F, 1, 1, -0.2F}, {0.1F, 0.1F, 0.4F, 0.4F}, {0.2F, 0.2F, 0.4F, 0.4F}};
  return {std::make_shared<Mesh>(corners, std::vector<Mesh::Triangle>{{0, 1, 2}, {0, 2, 3}},
                                 Vec3(0.7F, 0.2F, 0.1F))};
}

EnvironmentMap lamps(int width, int height) {
  EnvironmentMap map{width, height, 3, {}};
  for (int k = 0; k < 3 * width * height; ++k) map.data.push_back(static_cast<float>(k % 7));
  return map;
}

RenderParams water() {
  RenderParams params{.radius = 0.06F, .drop_radius = 0.03F, .particle_volume = 1.25e-4F};
  params.tank_lower = Vec3(0, 0, 0);
  params.tank_upper = Vec3(0.8F, 0.8F, 0.5F);
  return params;
}

Camera before() {
  Camera camera;
  camera.eye = {1.4F, 0.9F, 1.5F};
  camera.target = {0.4F, 0.2F, 0.25F};
  return camera;
}

struct Look {
  std::string name;
  RenderParams params = water();
  Camera camera = before();
  bool with_values = false;
};

std::vector<Look> looks() {
  std::vector<Look> all(14);
  int k = 0;
  const auto look = [&](const char* name) -> Look& {
    all[static_cast<std::size_t>(k)].name = name;
    return all[static_cast<std::size_t>(k++)];
  };
  look("water");
  look("ellipsoids").params.anisotropy = 1;
  look("narrow_range").params.smoothing = Smoothing::narrow_range;
  look("curvature_flow").params.smoothing = Smoothing::curvature_flow;
  look("wide filter").params.smoothing_radius = 100;
  look("no filter").params.smoothing_iterations = 0;
  look("map").params.background = Background::map;
  Look& clear = look("transparent");
  clear.params.background = Background::transparent;
  clear.params.supersampling = 3;
  Look& colored = look("colored");
  colored.with_values = true;
  colored.params.legend = "speed [m/s]";
  Look& spheres = look("spheres");
  spheres.with_values = true;
  spheres.params.style = Style::spheres;
  Look& parallel = look("parallel");
  parallel.camera.orthographic = true;
  parallel.camera.height = 1.5F;
  look("in the fluid").camera.eye = {0.1F, 0.1F, 0.1F};
  look("behind it").camera.target = {3, 2, 3};
  look("one sprite larger than the picture").params.radius = 50;
  return all;
}

}  // namespace

TEST_CASE("cpu_renderer: every feature at every size, the same bits with any instruction set") {
  const Points x = pool();
  const Scalars values = Scalars::LinSpaced(x.cols(), 0, 1);
  const Meshes meshes = board();
  for (const auto& [width, height] : {std::pair{1, 1}, std::pair{97, 53}, std::pair{30, 140}}) {
    for (const Look& look : looks()) {
      CAPTURE(look.name);
      CAPTURE(width);
      const auto drawn = [&] {
        CpuRenderer renderer(width, height);
        renderer.set_environment_map(lamps(width == 1 ? 1 : 33, width == 1 ? 1 : 16));
        const Scalars given = look.with_values ? values : Scalars();
        std::vector<std::uint8_t> bytes =
            renderer.render(x, look.camera, look.params, meshes, given).data;
        const Layers layers = renderer.layers(x, look.camera, look.params);
        const std::vector<float>& normal = layers.normal.data;
        const auto* numbers = reinterpret_cast<const std::uint8_t*>(normal.data());
        bytes.insert(bytes.end(), numbers, numbers + normal.size() * sizeof(float));
        return bytes;
      };
      setenv("PBF_ISA", isa_name(usable_isas().front()), 1);
      const std::vector<std::uint8_t> expected = drawn();
      for_each_isa([&] { CHECK(drawn() == expected); });
    }
  }
}

TEST_CASE("cpu_renderer: without particles the background, drawn or kept, in any size") {
  for (const int side : {1, 16, 65}) {
    CpuRenderer renderer(side, side);
    const Image image = renderer.render(Points(3, 0), before(), water(), {}, Scalars());
    CHECK(image.data.size() == static_cast<std::size_t>(4) * side * side);
    CHECK(renderer.render(Points(3, 0), before(), water()).data == image.data);
  }
}
