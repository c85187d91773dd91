#pragma once

#include "pbf/core/records.hpp"
#include "pbf/gl/buffer.hpp"
#include "pbf/gl/draw.hpp"
#include "pbf/gl/framebuffer.hpp"
#include "pbf/gl/program.hpp"
#include "pbf/render/colormap.hpp"
#include "pbf/render/params.hpp"

namespace pbf {

/// Particles and their colors on the graphics device, drawn as one quad each (glsl/spheres.vert).
class ColoredParticles {
 public:
  ColoredParticles() : buffer_(GL_ARRAY_BUFFER) { array_.instances(buffer_, 4, 0); }
  /// In the order of their distance from the eye, nearest first, so that a depth test drops as much
  /// as it can. @param colors  as many as particles
  void upload(const PointsView& positions, const Colors& colors, const Vec3& eye);
  void draw(Blend blend) const;

 private:
  Buffer buffer_;
  VertexArray array_;
  Records sorted_;
  GLsizei count_ = 0;
};

/// The particles themselves as opaque spheres: depth, normal and color of the nearest sphere at
/// each pixel, exactly where the viewing ray enters it.
class Spheres {
 public:
  explicit Spheres(const GlslSource& source);
  /// @param out  r32f affine depth, rgba32f normal (eye space) and packed color (glsl/color.glsl),
  /// and depth32f; all are cleared first
  void operator()(const ColoredParticles& particles, Real radius, const Framebuffer& out) const;

 private:
  Program program_;
};

}  // namespace pbf
