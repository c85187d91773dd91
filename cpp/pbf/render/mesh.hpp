#pragma once

#include "pbf/core/types.hpp"

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace pbf {

/// An opaque thing in the scene, of one color. Its triangles are counter-clockwise seen from
/// outside; they are not seen from inside.
class Mesh {
 public:
  using Triangle = std::array<std::int64_t, 3>;

  /// @param vertices   [m], finite
  /// @param triangles  three vertices each, counted from 0
  /// @param color      linear, 0 to 1
  /// Throws InvalidParameter.
  Mesh(Points vertices, std::vector<Triangle> triangles, const Vec3& color);
  [[nodiscard]] const Points& vertices() const { return vertices_; }
  [[nodiscard]] const std::vector<Triangle>& triangles() const { return triangles_; }
  [[nodiscard]] const Vec3& color() const { return color_; }

 private:
  Points vertices_;
  std::vector<Triangle> triangles_;
  Vec3 color_;
};

using Meshes = std::vector<std::shared_ptr<const Mesh>>;

}  // namespace pbf
