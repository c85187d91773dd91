#include "pbf/render/raster/backdrop.hpp"

#include "pbf/core/parallel.hpp"
#include "pbf/render/raster/composite_kernels.hpp"

#include <algorithm>

namespace pbf::raster {
namespace {

void draw(const Scene& scene, const Rectangle& reach, const Picture& out, int threads) {
  std::vector<Tile> tiles;
  for (int y = reach.y0 / kTileSide * kTileSide; y < reach.y1; y += kTileSide) {
    for (int x = reach.x0 / kTileSide * kTileSide; x < reach.x1; x += kTileSide) {
      tiles.push_back({x, y});
    }
  }
  const CompositeKernels& kernels = composite_kernels(chosen_isa());
  parallel_chunks(std::ssize(tiles), threads, 1, [&](Index first, Index) {
    kernels.backdrop(scene, tiles[static_cast<std::size_t>(first)], out);
  });
}

}  // namespace

void Backdrop::operator()(const Scene& scene,
                          const Camera& camera,
                          const RenderParams& params,
                          const Rectangle& in_shadow,
                          const Picture& out,
                          int threads) {
  const bool stays = kept_ != nullptr && kept_->width == out.width && kept_->height == out.height &&
                     same(kept_->camera, camera) && same(kept_->params, params);
  if (!stays) {
    kept_.reset();
    auto kept = std::make_unique<Kept>(Kept{camera, params, out.width, out.height, {}});
    kept->pixels.resize(static_cast<std::size_t>(out.width) * out.height);
    Scene without_shadow = scene;
    without_shadow.shadow.first = nullptr;
    draw(without_shadow, {0, 0, out.width, out.height},
         {kept->pixels.data(), out.width, out.width, out.height, out.light}, threads);
    kept_ = std::move(kept);
  }
  parallel_chunks(out.height, threads, kTileSide, [&](Index first, Index last) {
    for (Index y = first; y < last; ++y) {
      std::copy_n(kept_->pixels.data() + y * out.width, out.width, out.row(static_cast<int>(y)));
    }
  });
  if (scene.shadow.first != nullptr) draw(scene, in_shadow, out, threads);
}

}  // namespace pbf::raster
