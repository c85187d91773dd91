#include "pbf/render/raster/composite.hpp"

#include "pbf/core/parallel.hpp"
#include "pbf/render/raster/terms.hpp"

#include <array>
#include <cmath>
#include <numbers>

namespace pbf {
PBF_TABLE_BY_ISA(raster::CompositeKernels, composite_kernels, raster::composite_kernels)
}  // namespace pbf

namespace pbf::raster {
namespace {

/// Half the width of the tank's edges with the soft margin [pixels of the finished picture].
constexpr Real kEdgeHalfWidth = 1.3F;

Triple triple(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

/// The twelve edges of a box as far as they are in front of the near plane (glsl/tank_edges.vert).
void find_edges(const FrameTerms& frame, const Vec3& lower, const Vec3& upper, TankEdgeTerms& to) {
  const Eigen::Map<const Eigen::Matrix4f> view(frame.view);
  const auto corner = [&](int index) -> Vec3 {
    Vec3 p;
    for (int k = 0; k < 3; ++k) p[k] = (index >> k & 1) != 0 ? upper[k] : lower[k];
    return view.topLeftCorner<3, 3>() * p + view.topRightCorner<3, 1>();
  };
  const auto pixel = [&](Real slope, Real half, Real size) {
    return (slope / half * 0.5F + 0.5F) * size;
  };
  to.count = 0;
  for (int axis = 0; axis < 3; ++axis) {
    for (int bits = 0; bits < 4; ++bits) {
      // The other two coordinates are the bits.
      const int first = axis == 0 ? bits << 1 : axis == 1 ? (bits & 1) | ((bits & 2) << 1) : bits;
      Vec3 p = corner(first), q = corner(first | 1 << axis);
      const Real near = frame.near;
      if (-p.z() < near && -q.z() < near) continue;
      if (-p.z() < near) p += (near + p.z()) / (p.z() - q.z()) * (q - p);
      if (-q.z() < near) q += (near + q.z()) / (q.z() - p.z()) * (p - q);
      const Real spread_p = frame.perspective ? -p.z() : 1,
                 spread_q = frame.perspective ? -q.z() : 1;
      to.edges[to.count++] = {.ax = pixel(p.x() / spread_p, frame.half_width, frame.width),
                              .ay = pixel(p.y() / spread_p, frame.half_height, frame.height),
                              .bx = pixel(q.x() / spread_q, frame.half_width, frame.width),
                              .by = pixel(q.y() / spread_q, frame.half_height, frame.height),
                              .a = frame.perspective ? -1 / p.z() : p.z(),
                              .b = frame.perspective ? -1 / q.z() : q.z()};
    }
  }
}

/// The taps of glsl/sphere_shading.frag.
void find_taps(SphereTerms& to) {
  for (int k = 0; k < SphereTerms::kTaps; ++k) {
    const Real away = std::sqrt((static_cast<Real>(k) + 0.5F) / SphereTerms::kTaps);
    for (int row = 0; row < 4; ++row) {
      for (int lane = 0; lane < 16; ++lane) {
        const int column = lane & 3;
        const Real place =
            static_cast<Real>(column * 5 + row * 3) / 16 + 0.31F * static_cast<Real>(column ^ row);
        const Real turn = 6.2831853F * (place - std::floor(place));
        const Real angle = turn + 2.3999632F * static_cast<Real>(k);
        to.tap_x[k][row][lane] = away * std::cos(angle);
        to.tap_y[k][row][lane] = away * std::sin(angle);
      }
    }
  }
}

}  // namespace

Composite::Composite(const Scene& scene,
                     const RenderParams& params,
                     const OpaqueMeshes* meshes,
                     const Picture& out,
                     int threads)
    : scene_(scene),
      params_(params),
      opaque_meshes_(meshes),
      meshes_{},
      out_(out),
      threads_(threads) {
  if (meshes == nullptr) return;
  meshes_ = {
      .exist = true,
      .depth = texels_of(meshes->depth()),
      .light = {texels_of(meshes->red()), texels_of(meshes->green()), texels_of(meshes->blue())}};
}

template <class F>
void Composite::for_tiles(const Tiles& tiles, F&& f) const {
  const CompositeKernels& kernels = composite_kernels(chosen_isa());
  const std::vector<Tile> list = tiles.list();
  parallel_chunks(std::ssize(list), threads_, 1,
                  [&](Index first, Index) { f(kernels, list[static_cast<std::size_t>(first)]); });
}

void Composite::draw_meshes() const {
  if (opaque_meshes_ == nullptr) return;
  for_tiles(opaque_meshes_->tiles(), [&](const CompositeKernels& kernels, Tile tile) {
    kernels.meshes(scene_, meshes_, tile, out_);
  });
}

void Composite::draw(const Surface& surface) const {
  const Real disc = std::numbers::pi_v<Real> * params_.radius * params_.radius;
  const Vec3 absorption = surface.tint != nullptr ? params_.tint_absorption() : params_.absorption;
  FluidTerms terms{.depth = texels_of(surface.depth),
                   .thickness = texels_of(surface.thickness),
                   .back = texels_of(surface.back),
                   .spheres = texels_of(surface.spheres),
                   .normal = {texels_of(surface.normal.x), texels_of(surface.normal.y),
                              texels_of(surface.normal.z)},
                   .meshes = meshes_,
                   .has_tint = surface.tint != nullptr,
                   .tint = {},
                   .absorption = triple(absorption),
                   .scatter = triple(params_.scatter),
                   .refractive_index = params_.refractive_index,
                   .radius = params_.radius,
                   .drop_radius = params_.drop_radius_in_force(),
                   .sprite_thickness = params_.volume_in_force() / disc};
  if (surface.tint != nullptr) {
    const TintMaps& tint = *surface.tint;
    terms.tint[0] = texels_of(tint.red);
    terms.tint[1] = texels_of(tint.green);
    terms.tint[2] = texels_of(tint.blue);
    terms.tint[3] = texels_of(tint.weight);
  }
  for_tiles(surface.tiles, [&](const CompositeKernels& kernels, Tile tile) {
    kernels.fluid(scene_, terms, tile, out_);
  });
  draw_tank_edges(surface.depth, &surface.thickness, absorption);
}

void Composite::draw(const SphereMaps& spheres, const Tiles& tiles) const {
  SphereTerms terms{.depth = texels_of(spheres.depth),
                    .normal = {texels_of(spheres.normal.x), texels_of(spheres.normal.y),
                               texels_of(spheres.normal.z)},
                    .color = texels_of(spheres.color),
                    .meshes = meshes_,
                    .radius = params_.sphere_radius_in_force(),
                    .tap_x = {},
                    .tap_y = {}};
  find_taps(terms);
  for_tiles(tiles, [&](const CompositeKernels& kernels, Tile tile) {
    kernels.spheres(scene_, terms, tile, out_);
  });
  draw_tank_edges(spheres.depth, nullptr, params_.absorption);
}

void Composite::draw_tank_edges(const Map& depth,
                                const Map* thickness,
                                const Vec3& absorption) const {
  if (!params_.tank_lower) return;
  TankEdgeTerms terms{.depth = texels_of(depth),
                      .thickness = texels_of(thickness != nullptr ? *thickness : depth),
                      .meshes = meshes_,
                      .absorption = triple(absorption),
                      .opaque = thickness == nullptr,
                      .half_width = kEdgeHalfWidth * static_cast<Real>(params_.supersampling),
                      .edges = {},
                      .count = 0};
  find_edges(scene_.frame, *params_.tank_lower, *params_.tank_upper, terms);
  Tiles all(out_.width, out_.height);
  for (int row = 0; row < all.rows(); ++row) {
    for (int column = 0; column < all.columns(); ++column) all.mark(column, row);
  }
  for_tiles(all, [&](const CompositeKernels& kernels, Tile tile) {
    kernels.tank_edges(terms, tile, out_);
  });
}

}  // namespace pbf::raster
