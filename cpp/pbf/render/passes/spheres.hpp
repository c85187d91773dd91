#pragma once

#include "pbf/core/records.hpp"
#include "pbf/gl/buffer.hpp"
#include "pbf/gl/draw.hpp"
#include "pbf/gl/framebuffer.hpp"
#include "pbf/gl/program.hpp"
#include "pbf/render/colormap.hpp"
#include "pbf/render/frame_block.hpp"
#include "pbf/render/params.hpp"

namespace pbf {

/// Particles and their colors on the graphics device, drawn as a square each (glsl/spheres.vert):
/// as points, at a quarter of the vertices, unless one may be larger than drivers draw points.
class ColoredParticles {
 public:
  ColoredParticles() : buffer_(GL_ARRAY_BUFFER) {
    quads_.instances(buffer_, 4, 0);
    points_.vertices(buffer_, 4, 0);
  }
  /// In the order of their distance from the eye, nearest first, so that a depth test drops as much
  /// as it can.
  /// @param colors  as many as particles   @param radius  that they will be drawn with [m]
  void upload(const PointsView& positions,
              const Colors& colors,
              Real radius,
              const Vec3& eye,
              const FrameBlock& frame);
  /// The program for the way they are drawn.
  const Program& choose(ProgramVariants& programs, std::vector<std::string> defines) const;
  void draw(Blend blend) const;

 private:
  Buffer buffer_;
  VertexArray quads_, points_;
  bool as_points_ = false;
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
  void operator()(const ColoredParticles& particles, Real radius, const Framebuffer& out);

 private:
  ProgramVariants program_;
};

}  // namespace pbf
