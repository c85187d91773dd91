#include "pbf/render/read_back.hpp"

#include "pbf/gl/framebuffer.hpp"
#include "pbf/render/affine_depth.hpp"

#include <algorithm>

namespace pbf {
namespace {

template <class T>
Pixels<T> read(const Texture& texture, int channels, GLenum format, GLenum type) {
  Pixels<T> pixels{texture.width(), texture.height(), channels, {}};
  const auto row = static_cast<std::size_t>(pixels.width) * channels;
  pixels.data.resize(row * pixels.height);
  Framebuffer({&texture}).read(format, type, pixels.data.data());
  for (int y = 0; y < pixels.height / 2; ++y) {
    const auto low = pixels.data.begin() + static_cast<std::ptrdiff_t>(row * y);
    const auto high = pixels.data.end() - static_cast<std::ptrdiff_t>(row * (y + 1));
    std::swap_ranges(low, low + static_cast<std::ptrdiff_t>(row), high);
  }
  return pixels;
}

}  // namespace

Image read_rgba8(const Texture& texture) {
  return read<std::uint8_t>(texture, 4, GL_RGBA, GL_UNSIGNED_BYTE);
}

Pixels<float> read_floats(const Texture& texture, int channels) {
  return read<float>(texture, channels, channels == 1 ? GL_RED : GL_RGB, GL_FLOAT);
}

Pixels<float> read_depth(const Texture& texture, const Camera& camera) {
  Pixels<float> pixels = read_floats(texture, 1);
  for (float& a : pixels.data) a = depth_or_none(a, camera.orthographic);
  return pixels;
}

}  // namespace pbf
