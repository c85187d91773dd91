#pragma once

#include "pbf/gl/texture.hpp"

#include <array>
#include <initializer_list>

namespace pbf {

/// Draws into textures of one size, which must outlive it; one of format depth32f is its depth
/// buffer.
class Framebuffer {
 public:
  /// Throws GlError if the driver cannot draw into them.
  Framebuffer(std::initializer_list<const Texture*> targets);
  /// Makes it the place to draw to, all of it.
  void bind() const;
  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  void clear(int target, std::array<float, 4> value) const;
  /// To 0, the farthest for Blend::nearest.
  void clear_depth() const;
  /// To another of the same size, from the first target to its first.
  void copy_to(const Framebuffer& other) const;
  /// Rows from the bottom up, as many floats per pixel as the format has channels.
  void read(GLenum format, GLenum type, void* data) const;

 private:
  GlHandle<FramebufferKind> handle_;
  int width_, height_;
};

}  // namespace pbf
