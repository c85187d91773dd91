#include "pbf/render/raster/deep_thickness.hpp"
#include "pbf/render/raster/splats.hpp"

#include <doctest/doctest.h>

#include "clouds.hpp"
#include "instruction_sets.hpp"
#include <cmath>

using namespace pbf;
using test::for_each_isa;

namespace {

/// So many to a side of a cube, which is one meter long.
Points block(int side) {
  return (test::lattice(side, side, side).array() + 0.5F) / static_cast<Real>(side);
}

/// All of them deep, in a picture of 96 by 64 pixels.
raster::Map deep_thickness(const Points& x, const Camera& camera, Real radius, Real volume) {
  const FrameBlock frame = frame_block(camera, 96, 64);
  const raster::SplatView view =
      raster::splat_view(frame, {.radius = radius, .particle_volume = volume});
  raster::Map thickness(96, 64, 0);
  raster::Tiles tiles(96, 64);
  for (int row = 0; row < tiles.rows(); ++row) {
    for (int column = 0; column < tiles.columns(); ++column) tiles.mark(column, row);
  }
  thickness.begin(tiles);
  raster::DeepThickness deep;
  deep.find(x, std::vector(static_cast<std::size_t>(x.cols()), FullCells::Place::deep), view, 0);
  deep.add_to(thickness, tiles, 0);
  return thickness;
}

}  // namespace

TEST_CASE("deep_thickness: inside of a block it is that of the block, for sprites of any size") {
  constexpr int kSide = 40;
  Camera camera;
  camera.orthographic = true;
  camera.height = 0.4F;
  camera.eye = {0.5F, 0.5F, 3};
  camera.target = {0.5F, 0.5F, 0};
  const Points x = block(kSide);
  const Real volume = std::pow(1.0F / kSide, 3.0F);
  // From cells of two pixels, the smallest, to sixteen.
  for (const Real pixels : {0.5F, 3.0F, 9.0F, 20.0F}) {
    CAPTURE(pixels);
    const Real radius = pixels * 0.4F / 64;
    const raster::Map thickness = deep_thickness(x, camera, radius, volume);
    double sum = 0;
    for (int y = 0; y < 64; ++y) {
      for (int k = 0; k < 96; ++k) {
        sum += static_cast<double>(thickness.row(y)[k]);
        // Particles stand in rows, four pixels apart: what small cells make of them swings.
        if (pixels >= 9) CHECK(thickness.row(y)[k] == doctest::Approx(1).epsilon(0.02));
      }
    }
    CHECK(sum / (96 * 64) == doctest::Approx(1).epsilon(0.01));
  }
}

TEST_CASE("deep_thickness: along slanted rays of a wide lens it is the length of the ray") {
  constexpr int kSide = 40;
  Camera camera;
  camera.fov_y = 80;
  camera.eye = {0.5F, 0.5F, 0.9F};
  camera.target = {0.5F, 0.5F, 0};
  Points x = block(kSide);
  x.row(2) = -0.5F * x.row(2);  // a slab half as thick, of half the volume each
  x.topRows(2) = (4 * (x.topRows(2).array() - 0.5F) + 0.5F).matrix();
  const Real volume = 8 * std::pow(1.0F / kSide, 3.0F);
  const raster::Map thickness = deep_thickness(x, camera, 0.1F, volume);
  const double half = std::tan(40 * 3.14159265 / 180);
  // Particles stand in rows, so what a pixel gets of them swings around this.
  for (int top = 16; top < 48; top += 16) {
    for (int left = 16; left < 80; left += 16) {
      double found = 0, expected = 0;
      for (int y = top; y < top + 16; ++y) {
        for (int k = left; k < left + 16; ++k) {
          const double up = half * ((y + 0.5) / 32 - 1), right = 1.5 * half * ((k + 0.5) / 48 - 1);
          expected += 0.5 * std::sqrt(1 + up * up + right * right);
          found += static_cast<double>(thickness.row(y)[k]);
        }
      }
      CHECK(found == doctest::Approx(expected).epsilon(0.02));
    }
  }
}

TEST_CASE("deep_thickness: the same bits with every instruction set, none without deep ones") {
  Camera camera;
  camera.eye = {2, 1.5F, 2};
  camera.target = {0.5F, 0.5F, 0.5F};
  const Points x = block(30);
  const auto found = [&] {
    const raster::Map map = deep_thickness(x, camera, 0.04F, 3.7e-5F);
    std::vector<float> all;
    for (int y = 0; y < 64; ++y) all.insert(all.end(), map.row(y), map.row(y) + 96);
    return all;
  };
  const std::vector<float> expected = found();
  CHECK(*std::ranges::max_element(expected) > 0.9F);
  for_each_isa([&] { CHECK(found() == expected); });

  raster::Map thickness(96, 64, 0);
  raster::DeepThickness deep;
  const FrameBlock frame = frame_block(camera, 96, 64);
  deep.find(x, std::vector(static_cast<std::size_t>(x.cols()), FullCells::Place::body),
            raster::splat_view(frame, {.radius = 0.04F}), 0);
  raster::Tiles tiles(96, 64);
  tiles.mark(1, 1);
  deep.add_to(thickness, tiles, 0);
  CHECK(thickness.row(40)[40] == 0);
}
