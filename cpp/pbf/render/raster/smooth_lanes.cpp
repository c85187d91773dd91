// Compiled once per instruction set (cpp/pbf_render.cmake). The formulas are those of
// glsl/smooth.frag, where they are explained.
#include "pbf/render/raster/frame_lanes.hpp"
#include "pbf/render/raster/smooth_kernels.hpp"

namespace pbf::PBF_ISA_NAMESPACE {
namespace {

using raster::kTileSide;
using raster::Map;
using raster::SmoothKernels;
using raster::SmoothTerms;
using raster::Surroundings;
using raster::Tile;
using Kind = SmoothTerms::Kind;

constexpr float kMostPixels = 65536;

PBF_INLINE float highest(Lanes a) {
  float result = a.v[0];
  for (int lane = 1; lane < kLanes; ++lane) result = result > a.v[lane] ? result : a.v[lane];
  return result;
}

PBF_INLINE Lanes stride_of(const SmoothTerms& terms, Lanes radius) {
  return max(ceil(radius / Lanes(static_cast<float>(terms.most_taps))), Lanes(1));
}
PBF_INLINE Lanes gap_radius(const SmoothTerms& terms, Lanes radius) {
  const Lanes stride = stride_of(terms, radius);
  return select(stride > Lanes(1), Lanes(1.5F) * stride, Lanes(0));
}

PBF_INLINE Lanes radius_at(const SmoothTerms& terms, Lanes value, Lanes sphere) {
  const Lanes depth = terms.thickness ? sphere : value;
  Lanes radius(terms.radius);
  if (!terms.thickness) radius *= smoothing_share(sphere);
  if (terms.perspective) radius *= depth;
  if (terms.thickness) radius = select(value > Lanes(0), radius, Lanes(0));
  radius = min(select(depth > Lanes(kLeastSurface), radius, Lanes(0)), Lanes(kMostPixels));
  return terms.close_gaps ? gap_radius(terms, radius) : radius;
}

float radii(
    const SmoothTerms& terms, const Map& values, const Map& spheres, Tile tile, float* radius) {
  Lanes largest(0);
  for (int y = 0; y < kTileSide; ++y) {
    const float* value = values.row(tile.y + y) + tile.x;
    const float* sphere = spheres.row(tile.y + y) + tile.x;
    for (int x = 0; x < kTileSide; x += kLanes, radius += kLanes) {
      const Lanes r = radius_at(terms, load_lanes(value + x), load_lanes(sphere + x));
      largest = max(largest, r);
      store(radius, r);
    }
  }
  return highest(largest);
}

/// Lengths of the layer's own kind.
struct Window {
  Lanes down, up, behind;
};

PBF_INLINE Window window_at(const SmoothTerms& terms, Lanes a) {
  if (terms.thickness) return {Lanes(terms.range), Lanes(terms.range), Lanes(0)};
  const bool perspective = terms.perspective;
  return {farther(perspective, a, terms.range), nearer(perspective, a, terms.range),
          farther(perspective, a, terms.behind)};
}

/// The value of the fitted line, for pixels whose kernels have the same stride.
/// @param front  affine depth of the spheres
template <Kind kKind>
PBF_INLINE Lanes smoothed(const SmoothTerms& terms,
                          const Surroundings& around,
                          const float* at,
                          Lanes value,
                          Lanes radius,
                          Lanes front,
                          int stride) {
  const Lanes zero(0), one(1);
  const Lanes empty(terms.thickness ? 0.0F : kLeastSurface);
  const Lanes reach = radius / Lanes(static_cast<float>(stride));
  const float most = highest(reach);
  const bool along_row = around.columns > 0;
  const std::ptrdiff_t tap = along_row ? 1 : around.pitch;
  const int farthest = along_row ? around.columns : around.rows;
  const Window window = window_at(terms, value);
  const Lanes inverse_down = one / window.down, inverse_up = one / window.up;
  Lanes low = -window.down, high = window.up;
  Lanes open1 = one, open2 = one;
  Lanes space = one;
  Lanes ratio = exp(Lanes(-2) / (reach * reach));
  const Lanes ratio_step = ratio * ratio;
  // Bits of depth that only another surface has.
  const Mask body = is_body(front) & Mask{Ints{} + (terms.thickness ? 0 : -1)};
  const Ints strange = body.v & kDrop;
  const auto is_other = [&](Lanes a) PBF_LAMBDA_INLINE {
    return Mask{(reinterpret_cast<Ints>(a.v) & strange) != 0};
  };
  Lanes s0 = one, s1 = zero, s2 = zero, t0 = zero, t1 = zero;
  for (int k = 1; static_cast<float>(k - 1) < most && k * stride <= farthest; ++k) {
    const std::ptrdiff_t offset = k * stride * tap;
    const Lanes x(static_cast<float>(k));
    space *= ratio;
    ratio *= ratio_step;
    const Lanes weight = space * min(max(reach + one - x, zero), one);
    const Lanes next = load_lanes(at + offset), previous = load_lanes(at - offset);
    Mask exist1 = next > empty, exist2 = previous > empty;
    if constexpr (kKind == Kind::far_side) {
      exist1 = exist1 & (next < front);
      exist2 = exist2 & (previous < front);
    } else if constexpr (kKind == Kind::narrow_range) {
      open1 = select(exist1, open1, zero);
      open2 = select(exist2, open2, zero);
      exist1 = open1 > zero;
      exist2 = open2 > zero;
    }
    Lanes d1 = select(exist1, next - value, zero);
    Lanes d2 = select(exist2, previous - value, zero);
    Lanes w1 = select(exist1, weight, zero);
    Lanes w2 = select(exist2, weight, zero);
    if constexpr (kKind == Kind::bilateral) {
      const auto keep = [&](Lanes d) PBF_LAMBDA_INLINE {
        const Lanes u = max(-d * inverse_down, d * inverse_up);
        const Lanes inside = max(one - u * u, zero);
        return inside * inside;
      };
      w1 = select(is_other(next), zero, w1 * keep(d1));
      w2 = select(is_other(previous), zero, w2 * keep(d2));
    } else if constexpr (kKind == Kind::narrow_range) {
      const Mask in_front =
          (max(d1, d2) > high) | (exist1 & is_other(next)) | (exist2 & is_other(previous));
      const Mask behind1 = d1 < low, behind2 = d2 < low;
      const Lanes inside1 = select(behind1, zero, d1), inside2 = select(behind2, zero, d2);
      d1 = select(behind1, -window.behind, d1);
      d2 = select(behind2, -window.behind, d2);
      w1 = select(in_front, zero, w1);
      w2 = select(in_front, zero, w2);
      high = select(in_front, high, max(high, max(inside1, inside2) + window.up));
      low = select(in_front, low, min(low, min(inside1, inside2) - window.down));
    }
    const Lanes m1 = w1 * d1, m2 = w2 * d2;
    s0 += w1 + w2;
    s1 += x * (w1 - w2);
    s2 += x * x * (w1 + w2);
    t0 += m1 + m2;
    t1 += x * (m1 - m2);
  }
  const Lanes determinant = s0 * s2 - s1 * s1;
  const Mask solvable = determinant > Lanes(1e-6F) * s0 * s0;
  return value + select(solvable, (s2 * t0 - s1 * t1) / determinant, zero);
}

template <Kind kKind>
void smooth(const SmoothTerms& terms,
            const Surroundings& around,
            const float* radius,
            const float* spheres,
            float* out,
            std::ptrdiff_t pitch) {
  for (int y = 0; y < kTileSide; ++y) {
    for (int x = 0; x < kTileSide; x += kLanes, radius += kLanes) {
      const float* at = around.first + y * around.pitch + x;
      const Lanes value = load_lanes(at);
      const Lanes r = load_lanes(radius);
      const Lanes front = load_lanes(spheres + y * pitch + x);
      const Lanes stride = stride_of(terms, r);
      Lanes result = value;
      const int largest = static_cast<int>(highest(stride));
      for (int s = -static_cast<int>(highest(-stride)); s <= largest; ++s) {
        const Mask mine = stride == Lanes(static_cast<float>(s));
        const Lanes own = select(mine, r, Lanes(0));
        if (!(highest(own) > 0)) continue;
        const Lanes fitted = smoothed<kKind>(terms, around, at, value, own, front, s);
        result = select(own > Lanes(0), fitted, result);
      }
      if (terms.thickness) {
        result = max(result, Lanes(0));
      } else if (kKind != Kind::far_side) {
        result = select(is_surface(value), with_crowding_of(result, front), value);
      }
      store(out + y * pitch + x, result);
    }
  }
}

void smooth_any(const SmoothTerms& terms,
                const Surroundings& around,
                const float* radius,
                const float* spheres,
                float* out,
                std::ptrdiff_t pitch) {
  switch (terms.kind) {
    case Kind::bilateral:
      return smooth<Kind::bilateral>(terms, around, radius, spheres, out, pitch);
    case Kind::gaussian:
      return smooth<Kind::gaussian>(terms, around, radius, spheres, out, pitch);
    case Kind::far_side:
      return smooth<Kind::far_side>(terms, around, radius, spheres, out, pitch);
    case Kind::narrow_range:
      return smooth<Kind::narrow_range>(terms, around, radius, spheres, out, pitch);
  }
}

}  // namespace

const SmoothKernels& smooth_kernels() {
  static constexpr SmoothKernels kernels{radii, smooth_any};
  return kernels;
}

}  // namespace pbf::PBF_ISA_NAMESPACE
