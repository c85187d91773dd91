#include "pbf/gl/buffer.hpp"

namespace pbf {

void Buffer::bind() const { glBindBuffer(target_, handle_.name()); }

void Buffer::bind_base(GLuint index) const { glBindBufferBase(target_, index, handle_.name()); }

void Buffer::upload(const void* data, GLsizeiptr bytes) const {
  bind();
  glBufferData(target_, bytes, data, GL_STREAM_DRAW);
}

void VertexArray::vertices(
    const Buffer& vectors, GLint components, GLuint attribute, int which, int of) const {
  bind();
  vectors.bind();
  glEnableVertexAttribArray(attribute);
  const std::intptr_t bytes = components * static_cast<std::intptr_t>(sizeof(float));
  glVertexAttribPointer(attribute, components, GL_FLOAT, 0, static_cast<GLsizei>(of * bytes),
                        reinterpret_cast<const void*>(which * bytes));
}

void VertexArray::instances(
    const Buffer& vectors, GLint components, GLuint attribute, int which, int of) const {
  this->vertices(vectors, components, attribute, which, of);
  glVertexAttribDivisor(attribute, 1);
}

}  // namespace pbf
