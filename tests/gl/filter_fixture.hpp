#pragma once

#include "pbf/render/raster/map.hpp"

#include "gl_fixture.hpp"
#include <bit>
#include <cmath>

namespace pbf::test {

/// Where a filter runs: each has to pass the same tests.
enum class Way { glsl, cpp };
inline constexpr Way kWays[] = {Way::glsl, Way::cpp};

using Function = std::function<double(int, int)>;

/// A sphere's affine depth that carries a crowding: level 0 in a body of fluid, 3 for a drop.
inline double with_level(double affine_depth, std::uint32_t level) {
  const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(affine_depth));
  return std::bit_cast<float>((bits & ~3U) | level);
}

inline std::uint32_t level_of(double affine_depth) {
  return std::bit_cast<std::uint32_t>(static_cast<float>(affine_depth)) & 3U;
}

inline raster::Map map_of(const GlFixture& gl, const Function& value) {
  raster::Map map(gl.width(), gl.height(), kNothing);
  for (int y = 0; y < gl.height(); ++y) {
    for (int x = 0; x < gl.width(); ++x) map.row(y)[x] = static_cast<float>(value(x, y));
  }
  return map;
}

inline raster::Tiles all_tiles(const GlFixture& gl) {
  raster::Tiles tiles(gl.width(), gl.height());
  for (int row = 0; row < tiles.rows(); ++row) {
    for (int column = 0; column < tiles.columns(); ++column) tiles.mark(column, row);
  }
  return tiles;
}

inline std::vector<float> numbers_of(const GlFixture& gl, const raster::Map& map) {
  std::vector<float> result;
  for (int y = 0; y < gl.height(); ++y) {
    result.insert(result.end(), map.row(y), map.row(y) + gl.width());
  }
  return result;
}

inline Camera parallel(Real height) {
  Camera camera = GlFixture::looking_down_z();
  camera.orthographic = true;
  camera.height = height;
  return camera;
}

/// Bumps on a tilted plane, holes, steps and drops.
struct Rough {
  const GlFixture& gl;
  double near;
  [[nodiscard]] double depth(int x, int y) const {
    const double bump = 0.02 * std::sin(0.9 * x) * std::cos(0.7 * y);
    const double step = x > 150 ? 0.6 : 0;
    return near * (1 + 0.01 * x + 0.02 * y) + bump + step;
  }
  [[nodiscard]] double sphere(int x, int y) const {
    if (std::hypot(x - 60, y - 30) < 9 || x % 41 == 7) return kNothing;
    return with_level(1 / depth(x, y), static_cast<std::uint32_t>(x / 50) % 4);
  }
};

}  // namespace pbf::test
