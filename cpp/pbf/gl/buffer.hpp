#pragma once

#include "pbf/core/types.hpp"
#include "pbf/gl/handle.hpp"

namespace pbf {

/// A buffer whose whole content is replaced at a time, as each frame does.
class Buffer {
 public:
  explicit Buffer(GLenum target) : target_(target) {}
  void upload(const void* data, GLsizeiptr bytes) const;
  void bind_base(GLuint index) const;
  void bind() const;

 private:
  GLenum target_;
  GlHandle<BufferKind> handle_;
};

/// How vertices are fetched: nothing, or one vector per instance or per vertex from a
/// buffer.
class VertexArray {
 public:
  VertexArray() = default;
  /// Of each `of` vectors side by side, number `which`.
  void instances(
      const Buffer& vectors, GLint components, GLuint attribute, int which = 0, int of = 1) const;
  void vertices(
      const Buffer& vectors, GLint components, GLuint attribute, int which = 0, int of = 1) const;
  void bind() const { glBindVertexArray(handle_.name()); }

 private:
  GlHandle<VertexArrayKind> handle_;
};

}  // namespace pbf
