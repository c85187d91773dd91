#pragma once

#include "pbf/core/records.hpp"
#include "pbf/gl/egl_context.hpp"
#include "pbf/gl/framebuffer.hpp"
#include "pbf/render/frame_block.hpp"
#include "pbf/render/glsl_source.hpp"
#include "pbf/render/passes/fluid_tiles.hpp"
#include "pbf/render/passes/sphere_depth.hpp"

#include <doctest/doctest.h>

#include <functional>
#include <vector>

namespace pbf::test {

/// Particles of a body of fluid, or as crowded as said.
inline Records particles(const Points& positions, Real crowding = 1) {
  Records records(positions.cols());
  for (Index i = 0; i < positions.cols(); ++i) {
    records[i] = {positions(0, i), positions(1, i), positions(2, i), crowding};
  }
  return records;
}

/// A current context and the camera's uniform block, for passes that are called by hand.
class GlFixture {
 public:
  explicit GlFixture(int width = 64, int height = 48, const Camera& camera = looking_down_z())
      : current_(context_.make_current()),
        width_(width),
        height_(height),
        camera_(camera),
        block_(frame_block(camera, width, height)),
        frame_(GL_UNIFORM_BUFFER),
        tiles_(width, height) {
    frame_.upload(&block_, sizeof block_);
    frame_.bind_base(0);
    // One sphere around the eye reaches every tile.
    tiles_.find(Points(camera.eye), block_, camera.far / 2);
  }
  ~GlFixture() { CHECK(glGetError() == GL_NO_ERROR); }
  GlFixture(const GlFixture&) = delete;
  GlFixture& operator=(const GlFixture&) = delete;

  static Camera looking_down_z() {
    Camera camera;
    camera.eye = {0, 0, 0};
    camera.target = {0, 0, -1};
    camera.fov_y = 60;
    return camera;
  }

  /// Eye space x and y per unit of depth (perspective) or in meters (parallel) of a pixel's center.
  [[nodiscard]] double slope_x(int x) const {
    return (2 * (x + 0.5) / width_ - 1) * camera_.half_height() * width_ / height_;
  }
  [[nodiscard]] double slope_y(int y) const {
    return (2 * (y + 0.5) / height_ - 1) * camera_.half_height();
  }

  /// A texture from a function of pixel column and row, row 0 below.
  [[nodiscard]] Texture texture(const std::function<double(int, int)>& value) const {
    std::vector<float> data;
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; ++x) data.push_back(static_cast<float>(value(x, y)));
    }
    return {width_, height_, Format::r32f, data.data()};
  }
  [[nodiscard]] std::vector<float> read(const Texture& t, int channels = 1) const {
    std::vector<float> data(static_cast<std::size_t>(width_) * height_ * channels);
    Framebuffer({&t}).read(channels == 1 ? GL_RED : GL_RGB, GL_FLOAT, data.data());
    return data;
  }
  [[nodiscard]] const FluidTiles& tiles() const { return tiles_; }
  [[nodiscard]] const FrameBlock& frame() const { return block_; }
  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] std::size_t at(int x, int y) const {
    return static_cast<std::size_t>(y) * width_ + x;
  }
  [[nodiscard]] const EglContext& context() const { return context_; }

 private:
  EglContext context_;
  EglContext::Current current_;
  int width_, height_;
  Camera camera_;
  FrameBlock block_;
  Buffer frame_;
  FluidTiles tiles_;
};

}  // namespace pbf::test
