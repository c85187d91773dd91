#include "pbf/gl/framebuffer.hpp"

#include "pbf/core/error.hpp"

#include <string>
#include <vector>

namespace pbf {

Framebuffer::Framebuffer(std::initializer_list<const Texture*> targets)
    : width_((*targets.begin())->width()), height_((*targets.begin())->height()) {
  glBindFramebuffer(GL_FRAMEBUFFER, handle_.name());
  std::vector<GLenum> attachments;
  for (const Texture* texture : targets) {
    GLenum attachment = GL_DEPTH_ATTACHMENT;
    if (texture->format() != Format::depth32f) {
      attachment = GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(attachments.size());
      attachments.push_back(attachment);
    }
    glFramebufferTexture2D(GL_FRAMEBUFFER, attachment, GL_TEXTURE_2D, texture->name(), 0);
  }
  glDrawBuffers(static_cast<GLsizei>(attachments.size()), attachments.data());
  const GLenum status = glCheckFramebufferStatus(GL_FRAMEBUFFER);
  if (status != GL_FRAMEBUFFER_COMPLETE) {
    throw GlError("a framebuffer of " + std::to_string(width_) + "x" + std::to_string(height_) +
                  " pixels cannot be drawn to (status " + std::to_string(status) +
                  "): use a smaller image");
  }
}

void Framebuffer::bind() const {
  glBindFramebuffer(GL_FRAMEBUFFER, handle_.name());
  glViewport(0, 0, width_, height_);
}

void Framebuffer::clear(int target, std::array<float, 4> value) const {
  bind();
  glClearBufferfv(GL_COLOR, target, value.data());
}

void Framebuffer::clear_depth() const {
  bind();
  const float farthest = 0;
  glClearBufferfv(GL_DEPTH, 0, &farthest);
}

void Framebuffer::copy_to(const Framebuffer& other) const {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, handle_.name());
  glReadBuffer(GL_COLOR_ATTACHMENT0);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, other.handle_.name());
  glBlitFramebuffer(0, 0, width_, height_, 0, 0, width_, height_, GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

void Framebuffer::read(GLenum format, GLenum type, void* data) const {
  bind();
  glReadBuffer(GL_COLOR_ATTACHMENT0);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, width_, height_, format, type, data);
}

}  // namespace pbf
