#include "pbf/gl/buffer.hpp"

namespace pbf {

void Buffer::bind() const { glBindBuffer(target_, handle_.name()); }

void Buffer::bind_base(GLuint index) const { glBindBufferBase(target_, index, handle_.name()); }

void Buffer::upload(const void* data, GLsizeiptr bytes) const {
  bind();
  glBufferData(target_, bytes, data, GL_STREAM_DRAW);
}

void VertexArray::vertices(const Buffer& vectors, GLint components, GLuint attribute) const {
  bind();
  vectors.bind();
  glEnableVertexAttribArray(attribute);
  glVertexAttribPointer(attribute, components, GL_FLOAT, 0, 0, nullptr);
}

void VertexArray::instances(const Buffer& vectors, GLint components, GLuint attribute) const {
  this->vertices(vectors, components, attribute);
  glVertexAttribDivisor(attribute, 1);
}

}  // namespace pbf
