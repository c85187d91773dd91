#pragma once

#include "pbf/gl/handle.hpp"

namespace pbf {

/// Channels and precision of a texture.
/// srgb8: red, green and blue are linear wherever a shader reads or
/// writes them, and sRGB-encoded in memory, which is where 8 bits suffice; alpha is as it is.
enum class Format { r32f, rgba32f, rgba8, srgb8, depth32f };

/// What lies between the texels: the nearest one, or a linear mixture.
enum class Sampling { nearest, linear };

/// A two-dimensional texture without mipmaps, clamped to its edge.
class Texture {
 public:
  /// @param data  rows from the bottom up in the format's own type, or null for undefined content
  Texture(int width,
          int height,
          Format format,
          const void* data = nullptr,
          Sampling sampling = Sampling::nearest);
  void bind(int unit) const;
  /// Replaces the content.
  /// @param pitch  pixels from one row of the data to the next
  void upload(const void* data, int pitch) const;
  [[nodiscard]] GLuint name() const { return handle_.name(); }
  [[nodiscard]] Format format() const { return format_; }
  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }

 private:
  GlHandle<TextureKind> handle_;
  int width_, height_;
  Format format_;
};

}  // namespace pbf
