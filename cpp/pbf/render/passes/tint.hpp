#pragma once

#include "pbf/render/passes/spheres.hpp"

namespace pbf {

/// Color of the fluid at its surface, the mean of the particles there:
///
///   c = sum w_i c_i / sum w_i,   w_i = chord_i / R exp(-b_i / R),
///
/// over the sprites i that the pixel's ray goes through, chord the length inside and b how far
/// behind the surface the ray enters.
class Tint {
 public:
  explicit Tint(const GlslSource& source);
  /// @param depth  affine depth of the surface   @param radius  of the sprites [m]
  /// @param out  rgba32f: sum w c, linear, and sum w; cleared first. May be smaller than the
  /// picture: colors have no edges within a surface.
  void operator()(const ColoredParticles& particles,
                  const Texture& depth,
                  Real radius,
                  const Framebuffer& out);

 private:
  ProgramVariants program_;
};

}  // namespace pbf
