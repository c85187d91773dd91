#pragma once

#include "pbf/gl/buffer.hpp"
#include "pbf/gl/draw.hpp"

namespace pbf {

/// The particles on the graphics device, drawn as one quad each.
class Sprites {
 public:
  Sprites() : buffer_(GL_ARRAY_BUFFER) { array_.point_instances(buffer_, 0); }
  void upload(const PointsView& positions);
  void draw(Blend blend) const;

 private:
  Buffer buffer_;
  VertexArray array_;
  GLsizei count_ = 0;
};

}  // namespace pbf
