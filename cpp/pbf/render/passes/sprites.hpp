#pragma once

#include "pbf/core/records.hpp"
#include "pbf/gl/buffer.hpp"
#include "pbf/gl/draw.hpp"
#include "pbf/gl/program.hpp"
#include "pbf/render/params.hpp"

namespace pbf {

/// The particles on the graphics device, drawn as one quad each. How large depends on the
/// particle's crowding (crowding.hpp): a body's sprites overlap so far that they leave no holes,
/// and a drop is smaller.
class Sprites {
 public:
  Sprites();
  /// @param particles  position and crowding
  /// @param stretches  of ellipsoids (Anisotropy); empty: spheres
  void upload(const Records& particles, const Records& stretches = {});
  /// What the programs that draw them are compiled with.
  [[nodiscard]] std::vector<std::string> defines() const;
  /// Sets the uniforms of sprite.vert.
  static void set(const Program& program, const RenderParams& params);
  void draw(Blend blend) const;

 private:
  Buffer buffer_, stretches_;
  VertexArray spheres_, ellipsoids_;
  GLsizei count_ = 0;
  bool stretched_ = false;
};

}  // namespace pbf
