#pragma once

#include "pbf/render/environment.hpp"

#include <cstddef>
#include <cstdint>

// What the loops over the picture's pixels need to know, as plain numbers: they are compiled for
// several instruction sets.
namespace pbf::raster {

/// The uniform block of glsl/frame.glsl.
struct FrameTerms {
  float view[16];                 ///< world to eye space, column by column
  float half_width, half_height;  ///< of what is seen (at depth 1 in perspective) [m]
  float near, far;                ///< [m]
  float width, height;            ///< [pixels]
  bool perspective;
  float pixels_per_meter;  ///< in perspective at depth 1
};

/// A map's numbers.
struct Texels {
  const float* first;
  std::ptrdiff_t pitch;
  int width, height;
};

/// SunShadow's.
struct ShadowTexels {
  const std::uint8_t* first;  ///< null where nothing casts a shadow
  int width, height;
  Triple center, x, y;
};

/// An environment map and its mipmaps (panorama.hpp): four numbers a texel, row 0 below.
struct PanoramaTexels {
  static constexpr int kMostLevels = 15;
  struct Level {
    const float* first;
    int width, height;
  };
  Level levels[kMostLevels];
  int count = 0;
};

/// What shines on a picture.
struct Scene {
  FrameTerms frame;
  Environment environment;
  ShadowTexels shadow;
  PanoramaTexels map;
};

}  // namespace pbf::raster
