#pragma once

#include "pbf/core/isa.hpp"
#include "pbf/render/raster/picture.hpp"
#include "pbf/render/raster/scene.hpp"
#include "pbf/render/raster/tiles.hpp"

namespace pbf::raster {

/// Opaque meshes in the picture (opaque_meshes.hpp).
struct MeshTexels {
  bool exist;
  Texels depth;  ///< affine
  Texels light[3];
};

/// The uniforms of glsl/composite.frag.
struct FluidTerms {
  Texels depth, thickness, back;  ///< smoothed: affine; [m]; affine
  Texels spheres;                 ///< affine, with crowding
  Texels normal[3];               ///< in eye space
  MeshTexels meshes;
  bool has_tint;      ///< the fluid has its particles' colors
  Texels tint[4];     ///< weight times light, and weight, of half as many pixels to a side
  Triple absorption;  ///< [1/m]
  Triple scatter;
  float refractive_index;
  float radius, drop_radius;  ///< of sprites [m]
  float sprite_thickness;     ///< mean of a single one [m]
};

/// Those of glsl/sphere_shading.frag.
struct SphereTerms {
  static constexpr int kTaps = 16;
  Texels depth, normal[3], color;  ///< affine; in eye space; packed
  MeshTexels meshes;
  float radius;  ///< [m]
  /// Where the taps of a pixel lie in a disk of radius 1, by the pixel's row and column modulo 4;
  /// columns repeat, for vectors.
  float tap_x[kTaps][4][16], tap_y[kTaps][4][16];
};

/// An edge of the tank, from a to b (glsl/tank_edges.frag).
struct TankEdge {
  float ax, ay, bx, by;  ///< [pixels]
  float a, b;            ///< affine depth
};
struct TankEdgeTerms {
  Texels depth, thickness;  ///< of the fluid, affine and [m], or of spheres
  MeshTexels meshes;
  Triple absorption;  ///< [1/m]
  bool opaque;        ///< nothing is seen through
  float half_width;   ///< [pixels]
  TankEdge edges[12];
  int count;
};

/// The inner loops of the picture, for one instruction set. All but one work off a tile.
struct CompositeKernels {
  /// Sky and floor (glsl/backdrop.frag), in place of what is there; where there is a shadow, only
  /// what lies in it.
  void (*backdrop)(const Scene& scene, Tile tile, const Picture& picture);
  /// Meshes, in place of what is there.
  void (*meshes)(const Scene& scene, const MeshTexels& meshes, Tile tile, const Picture& picture);
  /// The fluid, over what is there.
  void (*fluid)(const Scene& scene, const FluidTerms& terms, Tile tile, const Picture& picture);
  /// The particles as opaque spheres, over what is there.
  void (*spheres)(const Scene& scene, const SphereTerms& terms, Tile tile, const Picture& picture);
  /// The edges of the tank, over what is there.
  void (*tank_edges)(const TankEdgeTerms& terms, Tile tile, const Picture& picture);
  /// A row of the smaller picture (glsl/resolve.frag).
  void (*resolve)(const Picture& picture, int factor, int y, const Picture& out);
};

const CompositeKernels& composite_kernels(Isa isa);

}  // namespace pbf::raster
