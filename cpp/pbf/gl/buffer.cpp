#include "pbf/gl/buffer.hpp"

namespace pbf {

void Buffer::bind() const { glBindBuffer(target_, handle_.name()); }

void Buffer::bind_base(GLuint index) const { glBindBufferBase(target_, index, handle_.name()); }

void Buffer::upload(const void* data, GLsizeiptr bytes) const {
  bind();
  glBufferData(target_, bytes, data, GL_STREAM_DRAW);
}

void VertexArray::point_instances(const Buffer& points, GLuint attribute) const {
  bind();
  points.bind();
  glEnableVertexAttribArray(attribute);
  glVertexAttribPointer(attribute, 3, GL_FLOAT, 0, 0, nullptr);
  glVertexAttribDivisor(attribute, 1);
}

}  // namespace pbf
