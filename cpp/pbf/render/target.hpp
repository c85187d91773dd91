#pragma once

#include "pbf/gl/framebuffer.hpp"

namespace pbf {

/// A texture and the framebuffer that draws into it.
struct Target {
  Target(int width, int height, Format format)
      : texture(width, height, format), framebuffer({&texture}) {}
  Texture texture;
  Framebuffer framebuffer;
};

}  // namespace pbf
