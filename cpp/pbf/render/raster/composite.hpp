#pragma once

#include "pbf/render/camera.hpp"
#include "pbf/render/params.hpp"
#include "pbf/render/raster/colored.hpp"
#include "pbf/render/raster/composite_kernels.hpp"
#include "pbf/render/raster/opaque_meshes.hpp"
#include "pbf/render/raster/picture.hpp"
#include "pbf/render/raster/scene.hpp"

namespace pbf::raster {

/// What composite draws from: smoothed affine depth, smoothed thickness [m], normals in eye space.
struct Surface {
  const Tiles& tiles;
  const Map& depth;
  const Map& thickness;
  const Map& back;     ///< smoothed affine depth of the far side
  const Map& spheres;  ///< affine depth with crowding, not smoothed
  const NormalMaps& normal;
  const TintMaps* tint;  ///< color of the fluid, null for its own
};

/// The pass of the same name in C++, in its parts, each over what is there.
class Composite {
 public:
  /// @param meshes  null: none
  Composite(const Scene& scene,
            const RenderParams& params,
            const OpaqueMeshes* meshes,
            const Picture& out,
            int threads);
  void draw_meshes() const;
  void draw(const Surface& surface) const;
  void draw(const SphereMaps& spheres, const Tiles& tiles) const;

 private:
  /// @param thickness  null for what is opaque
  void draw_tank_edges(const Map& depth, const Map* thickness, const Vec3& absorption) const;
  template <class F>
  void for_tiles(const Tiles& tiles, F&& f) const;

  const Scene& scene_;
  const RenderParams& params_;
  const OpaqueMeshes* opaque_meshes_;
  MeshTexels meshes_;
  Picture out_;
  int threads_;
};

}  // namespace pbf::raster
