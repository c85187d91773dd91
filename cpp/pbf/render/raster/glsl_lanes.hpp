#pragma once

// Words of GLSL that shaders have and core/lanes.hpp has not, so that both read alike.
#include "pbf/core/lanes.hpp"
#include "pbf/render/raster/scene.hpp"

namespace pbf::PBF_ISA_NAMESPACE {

PBF_INLINE Mask operator|(Mask a, Mask b) { return {a.v | b.v}; }
PBF_INLINE Mask operator~(Mask a) { return {~a.v}; }

PBF_INLINE Lanes abs(Lanes a) {
  return {reinterpret_cast<Lanes::Vector>(reinterpret_cast<Ints>(a.v) & 0x7FFFFFFF)};
}
/// Of numbers within ±2^31; cuts off what is behind the point.
PBF_INLINE Ints to_ints(Lanes a) { return __builtin_convertvector(a.v, Ints); }
PBF_INLINE Lanes to_lanes(Ints a) { return {__builtin_convertvector(a, Lanes::Vector)}; }
PBF_INLINE Ints clamp(Ints a, int low, int high) {
  const Ints least = low - Ints{}, most = high - Ints{};
  a = a < least ? least : a;
  return a > most ? most : a;
}

PBF_INLINE Lanes clamp(Lanes a, Lanes low, Lanes high) { return min(max(a, low), high); }
PBF_INLINE Lanes mix(Lanes a, Lanes b, Lanes share) { return a + share * (b - a); }
PBF_INLINE Lanes smoothstep(float low, float high, Lanes a) {
  const Lanes t = clamp((a - Lanes(low)) * Lanes(1 / (high - low)), 0.0F, 1.0F);
  return t * t * (Lanes(3) - Lanes(2) * t);
}

/// Natural logarithm of a normal number > 0, to 1e-7 of itself or of 1: the exponent, and the
/// series of artanh, log m = 2 (s + s^3/3 + …) with s = (m - 1) / (m + 1), |s| <= 0.172.
PBF_INLINE Lanes log(Lanes a) {
  const Ints bits = reinterpret_cast<Ints>(a.v);
  // The exponent that leaves a mantissa from sqrt(1/2) to sqrt(2).
  const Ints exponent = (bits - 0x3F3504F3) >> 23;
  const Lanes m(reinterpret_cast<Lanes::Vector>(bits - (exponent << 23)));
  const Lanes s = (m - Lanes(1)) / (m + Lanes(1));
  const Lanes s2 = s * s;
  Lanes sum = Lanes(1.0F / 9);
  for (const Real factor : {1.0F / 7, 1.0F / 5, 1.0F / 3, 1.0F}) sum = sum * s2 + Lanes(factor);
  return to_lanes(exponent) * Lanes(0.693147181F) + Lanes(2) * s * sum;
}
PBF_INLINE Lanes pow(Lanes a, float exponent) { return exp(log(a) * Lanes(exponent)); }

/// Of any point but the origin, to 1e-6: from [AS64] (4.4.49) within an eighth of a turn.
PBF_INLINE Lanes atan(Lanes y, Lanes x) {
  const Lanes ax = abs(x), ay = abs(y);
  const Lanes t = min(ax, ay) / max(max(ax, ay), Lanes(1e-30F)), t2 = t * t;
  Lanes sum = Lanes(0.0028662257F);
  for (const Real factor : {-0.0161657367F, 0.0429096138F, -0.0752896400F, 0.1065626393F,
                            -0.1420889944F, 0.1999355085F, -0.3333314528F, 1.0F}) {
    sum = sum * t2 + Lanes(factor);
  }
  Lanes angle = sum * t;
  angle = select(ay > ax, Lanes(1.57079633F) - angle, angle);
  angle = select(x < Lanes(0.0F), Lanes(3.14159265F) - angle, angle);
  return select(y < Lanes(0.0F), -angle, angle);
}
PBF_INLINE Lanes acos(Lanes a) { return atan(sqrt(max(Lanes(1) - a * a, 0.0F)), a); }

PBF_INLINE Vec3Lanes lanes(const Triple& t) { return {t.x, t.y, t.z}; }
PBF_INLINE Vec3Lanes operator-(const Vec3Lanes& a) { return {-a.x, -a.y, -a.z}; }
/// Number by number, as in GLSL: light through a filter.
PBF_INLINE Vec3Lanes operator*(const Vec3Lanes& a, const Vec3Lanes& b) {
  return {a.x * b.x, a.y * b.y, a.z * b.z};
}
PBF_INLINE Vec3Lanes select(Mask mask, const Vec3Lanes& a, const Vec3Lanes& b) {
  return {select(mask, a.x, b.x), select(mask, a.y, b.y), select(mask, a.z, b.z)};
}
PBF_INLINE Vec3Lanes mix(const Vec3Lanes& a, const Vec3Lanes& b, Lanes share) {
  return a + share * (b - a);
}
PBF_INLINE Vec3Lanes exp(const Vec3Lanes& a) { return {exp(a.x), exp(a.y), exp(a.z)}; }
PBF_INLINE Vec3Lanes abs(const Vec3Lanes& a) { return {abs(a.x), abs(a.y), abs(a.z)}; }
PBF_INLINE Vec3Lanes normalize(const Vec3Lanes& a) { return (Lanes(1) / sqrt(dot(a, a))) * a; }
PBF_INLINE Vec3Lanes reflect(const Vec3Lanes& a, const Vec3Lanes& n) {
  return a - (Lanes(2) * dot(n, a)) * n;
}
/// 0 where the ray is mirrored totally.
PBF_INLINE Vec3Lanes refract(const Vec3Lanes& a, const Vec3Lanes& n, float eta) {
  const Lanes c = dot(n, a);
  const Lanes k = Lanes(1) - Lanes(eta * eta) * (Lanes(1) - c * c);
  const Vec3Lanes bent = Lanes(eta) * a - (Lanes(eta) * c + sqrt(max(k, 0.0F))) * n;
  return select(k < Lanes(0.0F), Vec3Lanes{0.0F, 0.0F, 0.0F}, bent);
}

/// The numbers at places of an array.
PBF_INLINE Lanes fetch(const float* from, Ints at) {
  Lanes result;
  for (int lane = 0; lane < kLanes; ++lane) result.v[lane] = from[at[lane]];
  return result;
}
/// Of texels that are there.
PBF_INLINE Lanes fetch(const raster::Texels& from, Ints x, Ints y) {
  return fetch(from.first, y * static_cast<int>(from.pitch) + x);
}
PBF_INLINE Vec3Lanes fetch(const raster::Texels (&from)[3], Ints x, Ints y) {
  return {fetch(from[0], x, y), fetch(from[1], x, y), fetch(from[2], x, y)};
}

}  // namespace pbf::PBF_ISA_NAMESPACE
