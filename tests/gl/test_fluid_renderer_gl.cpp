#include "pbf/core/error.hpp"
#include "pbf/gl/functions.hpp"
#include "pbf/render/fluid_renderer.hpp"

#include <doctest/doctest.h>

#include <new>
#include <utility>

using namespace pbf;

namespace {

/// While it lives, the driver has no memory for textures of more pixels than this.
class LittleMemory {
 public:
  explicit LittleMemory(int pixels) {
    most_ = pixels;
    tex_image_2d_ = std::exchange(
        glTexImage2D, [](GLenum target, GLint level, GLint internal, GLsizei width, GLsizei height,
                         GLint border, GLenum format, GLenum type, const void* data) {
          if (width * height > most_) {
            error_ = GL_OUT_OF_MEMORY;
          } else {
            tex_image_2d_(target, level, internal, width, height, border, format, type, data);
          }
        });
    get_error_ = std::exchange(glGetError, [] {
      return error_ != GL_NO_ERROR ? std::exchange(error_, GL_NO_ERROR) : get_error_();
    });
  }
  ~LittleMemory() {
    glTexImage2D = tex_image_2d_;
    glGetError = get_error_;
  }
  LittleMemory(const LittleMemory&) = delete;
  LittleMemory& operator=(const LittleMemory&) = delete;

 private:
  static inline decltype(glTexImage2D) tex_image_2d_ = nullptr;
  static inline decltype(glGetError) get_error_ = nullptr;
  static inline int most_ = 0;
  static inline GLenum error_ = GL_NO_ERROR;
};

constexpr int kWidth = 40, kHeight = 30;
const Points kDrop{{0}, {0}, {0}};

EnvironmentMap gray(int width, int height, float light) {
  return {width, height, 3, std::vector<float>(std::size_t{3} * width * height, light)};
}

RenderParams mapped() { return {.radius = 0.5F, .background = Background::map, .floor = false}; }

}  // namespace

TEST_CASE("fluid_renderer: an environment map that cannot be had leaves the one before") {
  FluidRenderer renderer(kWidth, kHeight);
  renderer.set_environment_map(gray(8, 4, 0.4F));
  const Image before = renderer.render(kDrop, {}, mapped());
  {
    const LittleMemory memory(64 * 32 - 1);
    CHECK_THROWS_AS(renderer.set_environment_map(gray(64, 32, 0.9F)), std::bad_alloc);
  }
  CHECK_THROWS_WITH_AS(renderer.set_environment_map(gray(1 << 20, 1, 0.9F)),
                       doctest::Contains("environment_map: shape (1, 1048576, 3): this driver "
                                         "takes at most "),
                       InvalidParameter);
  EnvironmentMap torn = gray(8, 4, 0.9F);
  torn.data.pop_back();
  CHECK_THROWS_AS(renderer.set_environment_map(torn), InvalidParameter);
  CHECK(renderer.render(kDrop, {}, mapped()).data == before.data);
}

TEST_CASE("fluid_renderer: what fails for want of memory is drawn when there is some") {
  FluidRenderer renderer(kWidth, kHeight);
  const RenderParams small{.radius = 0.5F};
  RenderParams large = small;
  large.supersampling = 3;
  const Image expected_large = FluidRenderer(kWidth, kHeight).render(kDrop, {}, large);
  const Image expected = renderer.render(kDrop, {}, small);
  for (int k = 0; k < 2; ++k) {
    const LittleMemory memory(9 * kWidth * kHeight - 1);
    CHECK_THROWS_AS((void)renderer.render(kDrop, {}, large), std::bad_alloc);
    CHECK(renderer.render(kDrop, {}, small).data == expected.data);
  }
  CHECK(renderer.render(kDrop, {}, large).data == expected_large.data);
  const LittleMemory memory(kWidth * kHeight - 1);
  CHECK_THROWS_AS(FluidRenderer(kWidth, kHeight), std::bad_alloc);
}
