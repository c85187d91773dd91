#include "pbf/render/sun_shadow.hpp"

#include "pbf/core/parallel.hpp"
#include "pbf/render/deposit.hpp"
#include "pbf/render/extent.hpp"
#include "pbf/render/point_block.hpp"
#include "pbf/render/shadow_kernels.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>

namespace pbf {
PBF_TABLE_BY_ISA(ShadowKernels, shadow_kernels, shadow_kernels)
namespace {

constexpr int kThreads = 0;  // all there are
/// Width of the Gaussian and of the margin around the fluid [texels].
constexpr Real kDeviation = 2;
constexpr int kReach = 6;

using Grid = std::vector<Real>;

/// Two unit vectors across the sun's rays, and towards the sun: the rows.
Eigen::Matrix<Real, 3, 3> frame_of(const Vec3& sun) {
  const Vec3 other = std::abs(sun.x()) < 0.7F ? Vec3::UnitX() : Vec3::UnitZ();
  Eigen::Matrix<Real, 3, 3> frame;
  frame.row(0) = other.cross(sun).normalized();
  frame.row(1) = sun.cross(frame.row(0));
  frame.row(2) = sun;
  return frame;
}

Points corners_of(const Meshes& meshes) {
  Index count = 0;
  for (const auto& mesh : meshes) count += mesh->vertices().cols();
  Points corners(3, count);
  Index first = 0;
  for (const auto& mesh : meshes) {
    corners.middleCols(first, mesh->vertices().cols()) = mesh->vertices();
    first += mesh->vertices().cols();
  }
  return corners;
}

/// Thickness of the fluid towards the sun.
Grid columns(const PointsView& positions, const SunShadow& map, Real volume, Real texel) {
  const Vec3 u = static_cast<Real>(map.width) * map.x, v = static_cast<Real>(map.height) * map.y;
  const ShadowFrame frame{{map.center.x(), map.center.y(), map.center.z()},
                          {u.x(), u.y(), u.z()},
                          {v.x(), v.y(), v.z()},
                          0.5F * static_cast<Real>(map.width - 1),
                          0.5F * static_cast<Real>(map.height - 1),
                          map.width,
                          map.height};
  const ShadowKernels& kernels = shadow_kernels(chosen_isa());
  const std::array<Deposit::Size, 1> grids{{{map.width, map.height}}};
  Deposit deposit;
  deposit.add(grids, positions.cols(), kThreads, [&](Index first, Index last, Shares& shares) {
    kernels.share(point_block(positions, first, last), last - first, frame,
                  volume / (texel * texel), shares);
  });
  Grid sum(static_cast<std::size_t>(map.width) * map.height);
  deposit.add_to(sum, 0, kThreads);
  return sum;
}

/// 1 where the middle of a texel is behind a triangle; 0 in the margin.
Grid covered(const Meshes& meshes, const SunShadow& map) {
  Grid grid(static_cast<std::size_t>(map.width) * map.height);
  using Vec2 = Eigen::Matrix<Real, 2, 1>;
  const auto texel = [&](const Vec3& point) {
    const Vec3 p = point - map.center;
    return Vec2((map.x.dot(p) + 0.5F) * static_cast<Real>(map.width) - 0.5F,
                (map.y.dot(p) + 0.5F) * static_cast<Real>(map.height) - 0.5F);
  };
  const auto left_of = [](const Vec2& a, const Vec2& b, const Vec2& p) {
    return (b.x() - a.x()) * (p.y() - a.y()) - (b.y() - a.y()) * (p.x() - a.x());
  };
  // The arguments' order makes the first texel of what is too far off to be a number.
  const auto clamped = [](Real value, int size) {
    const Real last = static_cast<Real>(size - 1 - kReach);
    return static_cast<int>(std::min(std::max(static_cast<Real>(kReach), value), last));
  };
  for (const auto& mesh : meshes) {
    for (const Mesh::Triangle& triangle : mesh->triangles()) {
      std::array<Vec2, 3> t;
      for (int k = 0; k < 3; ++k) t[k] = texel(mesh->vertices().col(triangle[k]));
      const Vec2 low = t[0].cwiseMin(t[1]).cwiseMin(t[2]);
      const Vec2 high = t[0].cwiseMax(t[1]).cwiseMax(t[2]);
      const Real side = left_of(t[0], t[1], t[2]) < 0 ? Real{-1} : Real{1};
      for (int y = clamped(std::ceil(low.y()), map.height); y <= clamped(high.y(), map.height);
           ++y) {
        for (int x = clamped(std::ceil(low.x()), map.width); x <= clamped(high.x(), map.width);
             ++x) {
          const Vec2 p(static_cast<Real>(x), static_cast<Real>(y));
          if (side * left_of(t[0], t[1], p) >= 0 && side * left_of(t[1], t[2], p) >= 0 &&
              side * left_of(t[2], t[0], p) >= 0) {
            grid[static_cast<std::size_t>(y) * map.width + x] = 1;
          }
        }
      }
    }
  }
  return grid;
}

/// Weights of the Gaussian at 0, 1, … kReach texels; over both sides they add up to 1.
std::array<Real, kReach + 1> gaussian() {
  std::array<Real, kReach + 1> weights{};
  Real sum = 0;
  for (int k = 0; k <= kReach; ++k) {
    weights[k] = std::exp(-0.5F * static_cast<Real>(k * k) / (kDeviation * kDeviation));
    sum += k == 0 ? weights[k] : 2 * weights[k];
  }
  for (Real& weight : weights) weight /= sum;
  return weights;
}

/// Along texels `stride` apart; the border, kReach texels wide, stays as it is: empty.
Grid blurred(const Grid& grid, const SunShadow& map, int stride) {
  static const auto weights = gaussian();
  Grid result(grid.size());
  parallel_for(map.height, kThreads, [&](Index row) {
    if (stride > 1 && (row < kReach || row >= map.height - kReach)) return;
    const int margin = stride > 1 ? 0 : kReach;
    const std::size_t first = static_cast<std::size_t>(row) * map.width;
    for (std::size_t k = first + margin; k < first + map.width - margin; ++k) {
      Real sum = weights[0] * grid[k];
      for (int tap = 1; tap <= kReach; ++tap) {
        const auto away = static_cast<std::size_t>(tap) * stride;
        sum += weights[tap] * (grid[k - away] + grid[k + away]);
      }
      result[k] = sum;
    }
  });
  return result;
}

}  // namespace

RenderParams shadow_params(RenderParams params, bool tinted) {
  if (params.style == Style::spheres) {
    params.absorption = Vec3::Constant(2 / params.sphere_radius_in_force());
  } else if (tinted) {
    params.absorption = params.tint_absorption();
  }
  return params;
}

SunShadow sun_shadow(const PointsView& positions,
                     const RenderParams& params,
                     const Meshes& meshes) {
  const Vec3 sun = params.sun_direction.normalized();
  SunShadow map;
  if (!params.floor || params.shadow == 0) return map;
  if (sun.dot(params.up.normalized()) <= 0) return map;
  const Points corners = corners_of(meshes);
  if (positions.cols() == 0 && corners.cols() == 0) return map;
  const Eigen::Matrix<Real, 3, 3> frame = frame_of(sun);
  // Meshes belong to it as far as they are near the fluid, if there is any.
  Extent body = extent(positions.cols() > 0 ? positions : PointsView(corners), frame, kThreads);
  for (Index i = 0; i < corners.cols(); ++i) {
    body.include((frame * corners.col(i)).cast<double>().array());
  }
  // The Gaussian reaches three deviations, volumes go half a texel farther; then a white border.
  constexpr int kMargin = 2 * kReach + 2;
  const Eigen::Array3d size = body.upper - body.lower;
  const double texel =
      std::max(static_cast<double>(params.radius / kDeviation),
               std::max(size[0], size[1]) / (SunShadow::kMostTexels - 2 * kMargin));
  map.width = static_cast<int>(std::ceil(size[0] / texel)) + 2 * kMargin;
  map.height = static_cast<int>(std::ceil(size[1] / texel)) + 2 * kMargin;
  const Eigen::Vector3d middle = 0.5 * (body.lower + body.upper);
  map.center = (frame.topRows<2>().transpose().cast<double>() * middle.head<2>()).cast<Real>();
  map.x = frame.row(0) / static_cast<Real>(texel * map.width);
  map.y = frame.row(1) / static_cast<Real>(texel * map.height);
  Grid t = columns(positions, map, params.volume_in_force(), static_cast<Real>(texel));
  t = blurred(blurred(t, map, 1), map, map.width);
  Grid cover = covered(meshes, map);
  if (!meshes.empty()) cover = blurred(blurred(cover, map, 1), map, map.width);
  map.transmittance.assign(4 * t.size(), 255);
  parallel_for(static_cast<Index>(t.size()), kThreads, [&](Index k) {
    const Real length = t[static_cast<std::size_t>(k)];
    const Real open = 1 - cover[static_cast<std::size_t>(k)];
    if (length == 0 && open == 1) return;
    for (int c = 0; c < 3; ++c) {
      const Real rounded = 255 * std::exp(-params.absorption[c] * length) * open + 0.5F;
      map.transmittance[static_cast<std::size_t>(4 * k + c)] = static_cast<std::uint8_t>(rounded);
    }
  });
  return map;
}

}  // namespace pbf
