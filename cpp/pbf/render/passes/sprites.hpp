#pragma once

#include "pbf/core/records.hpp"
#include "pbf/gl/buffer.hpp"
#include "pbf/gl/draw.hpp"
#include "pbf/gl/program.hpp"
#include "pbf/render/params.hpp"

namespace pbf {

/// The particles on the graphics device, drawn as one quad each. How large depends on the
/// particle's crowding (crowding.hpp): a body's sprites overlap so far that they leave no holes,
/// and a drop is smaller.
class Sprites {
 public:
  Sprites() : buffer_(GL_ARRAY_BUFFER) { array_.instances(buffer_, 4, 0); }
  /// @param particles  position and crowding
  void upload(const Records& particles);
  /// Sets the uniforms of sprite.vert.
  static void set(const Program& program, const RenderParams& params);
  void draw(Blend blend) const;

 private:
  Buffer buffer_;
  VertexArray array_;
  GLsizei count_ = 0;
};

}  // namespace pbf
