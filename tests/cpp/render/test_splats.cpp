#include "pbf/render/raster/splats.hpp"
#include "pbf/render/raster/surface_maps.hpp"

#include <doctest/doctest.h>

#include "drawn_splats.hpp"
#include "instruction_sets.hpp"
#include <algorithm>
#include <cmath>
#include <random>
#include <string>

using namespace pbf;
using namespace pbf::raster;
using namespace pbf::test;

namespace {

constexpr int kWidth = 200, kHeight = 150;

Camera ahead() {
  Camera camera;
  camera.eye = {0, 0, 0};
  camera.target = {0, 0, -1};
  return camera;
}

DrawnSplats draw(const Records& particles, const RenderParams& params, int threads) {
  const FrameBlock frame = frame_block(ahead(), kWidth, kHeight);
  return draw_splats(particles, nullptr, frame, kWidth, kHeight, params, threads);
}

Records cloud(Index n) {
  std::mt19937 random(3);
  std::uniform_real_distribution<Real> anywhere(-1, 1);
  Records particles(n);
  for (Index i = 0; i < n; ++i) {
    particles[i] = {anywhere(random), anywhere(random), -2 + 2.2F * anywhere(random),
                    0.5F + 0.5F * anywhere(random)};
  }
  return particles;
}

}  // namespace

TEST_CASE("splats: the same bits for any number of threads") {
  RenderParams params;
  params.radius = 0.06F;
  params.drop_radius = 0.03F;
  const Records particles = cloud(40000);
  const DrawnSplats expected = draw(particles, params, 1);
  CHECK(std::ranges::count(expected.depth, kNothing) < kWidth * kHeight / 2);
  for (const int threads : {2, 3, 7}) CHECK(draw(particles, params, threads) == expected);
}

TEST_CASE("splats: every instruction set draws the same bits") {
  RenderParams params;
  params.radius = 0.06F;
  const Records particles = cloud(3000);
  const DrawnSplats expected = draw(particles, params, 2);
  for_each_isa([&] { CHECK(draw(particles, params, 2) == expected); });
}

TEST_CASE("splats: tiles are those that any of the sprites covers") {
  const FrameBlock frame = frame_block(ahead(), kWidth, kHeight);
  const Records particles = cloud(60);
  Points positions(3, particles.size());
  Tiles expected(kWidth, kHeight), marked(kWidth, kHeight);
  for (Index i = 0; i < particles.size(); ++i) {
    const Record& p = particles[i];
    positions.col(i) << p.x, p.y, p.z;
    Records one(1);
    one[0] = {p.x, p.y, p.z, 1};
    Splats splats;
    splats.bin(one.data(), 1, splat_view(frame, {.radius = 0.06F}), 1);
    for (const Tile& tile : splats.tiles().list()) {
      expected.mark(tile.x / kTileSide, tile.y / kTileSide);
    }
  }
  mark_tiles(positions, 0.06F, frame, marked);
  const auto text = [](const Tiles& tiles) {
    std::string corners;
    for (const Tile& tile : tiles.list()) {
      corners += std::to_string(tile.x) + "," + std::to_string(tile.y) + " ";
    }
    return corners;
  };
  CHECK(marked.list().size() > 5);
  CHECK(marked.list().size() < 35);
  CHECK(text(marked) == text(expected));
}

TEST_CASE("splats: sprites of many tiles count as small ones do") {
  // As many tiles as make a sprite large, or one less: the sum of both is that of drawing each.
  RenderParams params;
  params.radius = 1.2F;
  params.drop_radius = 0.05F;
  Records large(1), small(1), both(2);
  both[0] = large[0] = {0.1F, 0, -2, 1};
  both[1] = small[0] = {-0.3F, 0.2F, -1, 0};
  const DrawnSplats one = draw(large, params, 1), other = draw(small, params, 1);
  const DrawnSplats together = draw(both, params, 1);
  for (std::size_t k = 0; k < one.depth.size(); ++k) {
    CHECK(together.depth[k] == std::max(one.depth[k], other.depth[k]));
    CHECK(together.thickness[k] == one.thickness[k] + other.thickness[k]);
  }
}

TEST_CASE("splats: deep ones, added to coarse grids, are as thick, and none of them is missed") {
  std::mt19937 random(3);
  std::uniform_real_distribution<Real> shake(-0.2F, 0.2F);
  constexpr Index kSide = 24;
  Points x(3, kSide * kSide * kSide);
  for (Index i = 0; i < x.cols(); ++i) {
    const Eigen::Vector3<Index> at(i % kSide, i / kSide % kSide, i / (kSide * kSide));
    x.col(i) = 0.04F * (at.cast<Real>() + Vec3(shake(random), shake(random), shake(random)));
  }
  RenderParams params;
  params.radius = params.drop_radius.emplace(0.048F);
  params.particle_volume = 0.04F * 0.04F * 0.04F;
  Camera outside, inside, cut;
  outside.eye = {1.8F, 1.2F, 1.9F};
  outside.target = inside.target = cut.target = {0.5F, 0.4F, 0.4F};
  inside.eye = {0.45F, 0.55F, 0.7F};
  cut.eye = {0.5F, 0.4F, 2};
  cut.near = 1.5F;
  cut.orthographic = true;
  for (const Camera& camera : {outside, inside, cut}) {
    CAPTURE(camera.eye.transpose());
    SurfaceMaps all(kWidth, kHeight), split(kWidth, kHeight), by_one(kWidth, kHeight);
    all.find(x, camera, params, SurfaceMaps::For::layers);
    split.find(x, camera, params, SurfaceMaps::For::picture, 3);
    by_one.find(x, camera, params, SurfaceMaps::For::picture, 1);
    double difference = 0, sum = 0;
    float largest = 0;
    int covered = 0;
    for (int y = 0; y < kHeight; ++y) {
      for (int k = 0; k < kWidth; ++k) {
        const float expected = all.thickness_smooth().row(y)[k];
        const float error = std::abs(split.thickness_smooth().row(y)[k] - expected);
        if (!(all.depth().row(y)[k] > kNothing)) continue;
        CHECK(by_one.thickness_smooth().row(y)[k] == split.thickness_smooth().row(y)[k]);
        CHECK(split.depth().row(y)[k] == all.depth().row(y)[k]);
        ++covered;
        difference += static_cast<double>(error);
        sum += static_cast<double>(expected);
        largest = std::max(largest, error);
      }
    }
    CHECK(covered > 3000);
    CHECK(difference < 0.002 * sum);
    CHECK(largest < 0.01F);  // a quarter of a particle distance
  }
}
