#pragma once

#include "pbf/gl/buffer.hpp"
#include "pbf/gl/framebuffer.hpp"
#include "pbf/gl/program.hpp"

namespace pbf {

/// A picture from a larger one: the mean of factor² pixels, in linear light. Colors that come
/// multiplied by alpha go out divided by it, as image files want them.
class Resolve {
 public:
  explicit Resolve(const GlslSource& source);
  /// @param color  srgb8, `factor` times as wide and high as `out`, srgb8 too
  void operator()(const Texture& color, int factor, const Framebuffer& out) const;

 private:
  Program program_;
  VertexArray no_vertices_;
};

}  // namespace pbf
