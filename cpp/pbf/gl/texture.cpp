#include "pbf/gl/texture.hpp"

#include "pbf/gl/error.hpp"

namespace pbf {
namespace {

struct Layout {
  GLenum internal, format, type;
};

Layout layout_of(Format format) {
  switch (format) {
    case Format::r32f:
      return {GL_R32F, GL_RED, GL_FLOAT};
    case Format::rgba32f:
      return {GL_RGBA32F, GL_RGBA, GL_FLOAT};
    case Format::rgba16f:
      return {GL_RGBA16F, GL_RGBA, GL_FLOAT};
    case Format::srgb8:
      return {GL_SRGB8_ALPHA8, GL_RGBA, GL_UNSIGNED_BYTE};
    case Format::depth32f:
      return {GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, GL_FLOAT};
    case Format::rgba8:
      break;
  }
  return {GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE};
}

/// The unit in which textures are made and filled, so that what a pass has bound stays bound. Every
/// driver has it.
constexpr int kNobodys = 15;

}  // namespace

Texture::Texture(int width, int height, Format format, const void* data, Sampling sampling)
    : width_(width), height_(height), format_(format) {
  const Layout layout = layout_of(format);
  bind(kNobodys);
  const bool panorama = sampling == Sampling::panorama;
  const GLint filter = sampling == Sampling::nearest ? GL_NEAREST : GL_LINEAR;
  if (!panorama) glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER,
                  panorama ? GL_LINEAR_MIPMAP_LINEAR : filter);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, panorama ? GL_REPEAT : GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  glTexImage2D(GL_TEXTURE_2D, 0, static_cast<GLint>(layout.internal), width, height, 0,
               layout.format, layout.type, data);
  if (panorama) glGenerateMipmap(GL_TEXTURE_2D);
  require_no_gl_error();
}

void Texture::upload(const void* data, int pitch) const {
  const Layout layout = layout_of(format_);
  bind(kNobodys);
  glPixelStorei(GL_UNPACK_ROW_LENGTH, pitch);
  glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width_, height_, layout.format, layout.type, data);
  glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
}

void Texture::bind(int unit) const {
  glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
  glBindTexture(GL_TEXTURE_2D, handle_.name());
}

}  // namespace pbf
