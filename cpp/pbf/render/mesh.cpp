#include "pbf/render/mesh.hpp"

#include "pbf/core/error.hpp"
#include "pbf/core/fields.hpp"

namespace pbf {

Mesh::Mesh(Points vertices, std::vector<Triangle> triangles, const Vec3& color)
    : vertices_(std::move(vertices)), triangles_(std::move(triangles)), color_(color) {
  const Index n = vertices_.cols();
  for (Index k = 0; k < n; ++k) {
    if (!vertices_.col(k).allFinite()) {
      throw InvalidParameter("Mesh.vertices: row " + std::to_string(k) +
                             " is not finite; every coordinate must be");
    }
  }
  for (std::size_t k = 0; k < triangles_.size(); ++k) {
    for (const std::int64_t vertex : triangles_[k]) {
      if (vertex < 0 || vertex >= n) {
        throw InvalidParameter("Mesh.faces: row " + std::to_string(k) + " names vertex " +
                               std::to_string(vertex) + ", but there are " + std::to_string(n) +
                               "; vertices are counted from 0");
      }
    }
  }
  if (!(color_.array() >= 0 && color_.array() <= 1).all()) {
    throw InvalidParameter("Mesh.color = " + to_text(color_) +
                           ": each of red, green and blue must be from 0 to 1");
  }
}

}  // namespace pbf
