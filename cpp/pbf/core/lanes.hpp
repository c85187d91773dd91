#pragma once

// For the files that are compiled once per instruction set, and for no others: PBF_ISA_NAMESPACE
// names the one at hand. Nothing here may stand outside that namespace, or the linker could pick a
// function compiled for AVX-512 for everybody.
#ifndef PBF_ISA_NAMESPACE
#error "core/lanes.hpp is for files that are compiled once per instruction set"
#endif

#include "pbf/core/records.hpp"

#include <cmath>
#include <cstring>
#if defined(__AVX2__)
#include <immintrin.h>
#endif

namespace pbf::PBF_ISA_NAMESPACE {

#define PBF_INLINE __attribute__((always_inline)) inline
#define PBF_LAMBDA_INLINE __attribute__((always_inline))

/// Particles that one vector works for.
#if defined(__AVX512F__)
inline constexpr int kLanes = 16;
#elif defined(__AVX2__)
inline constexpr int kLanes = 8;
#else
inline constexpr int kLanes = 4;
#endif

/// A condition for each lane.
struct Mask {
  using Vector = std::int32_t __attribute__((vector_size(4 * kLanes)));
  Vector v;  // all bits of a lane are set where it holds
};

using Ints = Mask::Vector;

/// 0, 1, 2 …
PBF_INLINE Ints lane_numbers() {
  Ints result;
  for (int lane = 0; lane < kLanes; ++lane) result[lane] = lane;
  return result;
}
/// So many lanes, or all: those of a vector that holds the last of something.
PBF_INLINE Mask first_lanes(Index count) {
  return {lane_numbers() < (static_cast<std::int32_t>(count) - Ints{})};
}

/// A number for each of kLanes particles, in the compiler's own vector type (GCC and Clang: "Vector
/// Extensions"). Arithmetic rounds like that of float, so results do not depend on kLanes.
struct Lanes {
  using Vector = float __attribute__((vector_size(4 * kLanes)));
  Vector v;

  Lanes() = default;
  PBF_INLINE Lanes(Vector vector) : v(vector) {}
  PBF_INLINE Lanes(Real number) : v(number - Vector{}) {}

  PBF_INLINE Lanes& operator+=(Lanes b) { return *this = Lanes(v + b.v); }
  PBF_INLINE Lanes& operator-=(Lanes b) { return *this = Lanes(v - b.v); }
  PBF_INLINE Lanes& operator*=(Lanes b) { return *this = Lanes(v * b.v); }
  friend PBF_INLINE Lanes operator+(Lanes a, Lanes b) { return {a.v + b.v}; }
  friend PBF_INLINE Lanes operator-(Lanes a, Lanes b) { return {a.v - b.v}; }
  friend PBF_INLINE Lanes operator*(Lanes a, Lanes b) { return {a.v * b.v}; }
  friend PBF_INLINE Lanes operator/(Lanes a, Lanes b) { return {a.v / b.v}; }
  friend PBF_INLINE Lanes operator-(Lanes a) { return {-a.v}; }
  friend PBF_INLINE Mask operator<(Lanes a, Lanes b) { return {a.v < b.v}; }
  friend PBF_INLINE Mask operator<=(Lanes a, Lanes b) { return {a.v <= b.v}; }
  friend PBF_INLINE Mask operator>(Lanes a, Lanes b) { return {a.v > b.v}; }
  friend PBF_INLINE Mask operator==(Lanes a, Lanes b) { return {a.v == b.v}; }
};

PBF_INLINE Mask operator&(Mask a, Mask b) { return {a.v & b.v}; }
/// Bit k says whether lane k is set.
PBF_INLINE unsigned bits(Mask mask) {
#if defined(__AVX512F__)
  return _mm512_movepi32_mask(reinterpret_cast<__m512i>(mask.v));
#elif defined(__AVX2__)
  return static_cast<unsigned>(_mm256_movemask_ps(reinterpret_cast<__m256>(mask.v)));
#else
  unsigned result = 0;
  for (int lane = 0; lane < kLanes; ++lane) result |= mask.v[lane] != 0 ? 1U << lane : 0U;
  return result;
#endif
}
PBF_INLINE bool any(Mask mask) { return bits(mask) != 0; }

/// a where the mask holds, b elsewhere.
PBF_INLINE Lanes select(Mask mask, Lanes a, Lanes b) { return {mask.v ? a.v : b.v}; }

/// a > b ? a : b, b where one is not a number. (The compilers do not find the instruction.)
PBF_INLINE Lanes max(Lanes a, Lanes b) {
#if defined(__AVX512F__)
  return {_mm512_max_ps(a.v, b.v)};
#elif defined(__AVX2__)
  return {_mm256_max_ps(a.v, b.v)};
#else
  return select(a > b, a, b);
#endif
}

/// a < b ? a : b, b where one is not a number.
PBF_INLINE Lanes min(Lanes a, Lanes b) {
#if defined(__AVX512F__)
  return {_mm512_min_ps(a.v, b.v)};
#elif defined(__AVX2__)
  return {_mm256_min_ps(a.v, b.v)};
#else
  return select(a < b, a, b);
#endif
}

PBF_INLINE Lanes sqrt(Lanes a) {
#if defined(__AVX512F__)
  return {_mm512_sqrt_ps(a.v)};
#elif defined(__AVX2__)
  return {_mm256_sqrt_ps(a.v)};
#else
  for (int lane = 0; lane < kLanes; ++lane) a.v[lane] = __builtin_sqrtf(a.v[lane]);
  return a;
#endif
}

/// Next whole number upwards, of numbers within ±2^31.
PBF_INLINE Lanes ceil(Lanes a) {
  const Lanes cut = {
      __builtin_convertvector(__builtin_convertvector(a.v, Mask::Vector), Lanes::Vector)};
  return select(cut < a, cut + Lanes(1), cut);
}
PBF_INLINE Lanes floor(Lanes a) { return -ceil(-a); }

/// e^a within two units in the last place, of -87 for less, of 88 for more.
PBF_INLINE Lanes exp(Lanes a) {
  a = min(max(a, Lanes(-87)), Lanes(88));
  // a = n ln 2 + r, |r| <= ln 2 / 2; adding 1.5 * 2^23 rounds to whole numbers.
  const Lanes n = (a * Lanes(1.44269504F) + Lanes(12582912)) - Lanes(12582912);
  const Lanes r = (a - n * Lanes(0.693359375F)) + n * Lanes(2.12194440e-4F);
  Lanes sum = Lanes(1.0F / 5040);
  for (const Real factor : {1.0F / 720, 1.0F / 120, 1.0F / 24, 1.0F / 6, 0.5F, 1.0F, 1.0F}) {
    sum = sum * r + Lanes(factor);
  }
  const auto power = (__builtin_convertvector(n.v, Mask::Vector) + 127) << 23;
  return sum * Lanes(reinterpret_cast<Lanes::Vector>(power));
}

template <class T>
PBF_INLINE T load(const void* from) {
  T value;
  std::memcpy(&value, from, sizeof value);
  return value;
}
PBF_INLINE Lanes load_lanes(const Real* from) { return load<Lanes>(from); }
PBF_INLINE void store(Real* to, Lanes value) { std::memcpy(to, &value, sizeof value); }

/// A vector of space for each of kLanes particles.
struct Vec3Lanes {
  Lanes x, y, z;

  PBF_INLINE Vec3Lanes& operator+=(const Vec3Lanes& b) { return *this = *this + b; }
  PBF_INLINE Vec3Lanes& operator-=(const Vec3Lanes& b) { return *this = *this - b; }
  friend PBF_INLINE Vec3Lanes operator+(const Vec3Lanes& a, const Vec3Lanes& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  friend PBF_INLINE Vec3Lanes operator-(const Vec3Lanes& a, const Vec3Lanes& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
  friend PBF_INLINE Vec3Lanes operator*(Lanes s, const Vec3Lanes& a) {
    return {s * a.x, s * a.y, s * a.z};
  }
};

PBF_INLINE Lanes dot(const Vec3Lanes& a, const Vec3Lanes& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
PBF_INLINE Vec3Lanes cross(const Vec3Lanes& a, const Vec3Lanes& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// The records of kLanes particles, number by number.
struct RecordLanes {
  Vec3Lanes xyz;
  Lanes w;
};

using Four = float __attribute__((vector_size(16)));

// Within each group of four lanes: the two pairs' first or second halves.
#if defined(__AVX512F__)
#define PBF_SHUFFLE(a, b, i, j, k, l)                                                        \
  __builtin_shufflevector(a, b, i, j, k, l, i + 4, j + 4, k + 4, l + 4, i + 8, j + 8, k + 8, \
                          l + 8, i + 12, j + 12, k + 12, l + 12)
#elif defined(__AVX2__)
#define PBF_SHUFFLE(a, b, i, j, k, l) \
  __builtin_shufflevector(a, b, i, j, k, l, i + 4, j + 4, k + 4, l + 4)
#else
#define PBF_SHUFFLE(a, b, i, j, k, l) __builtin_shufflevector(a, b, i, j, k, l)
#endif

/// Columns of four, from each group of four lanes: the 4×4 transposition, group by group.
struct Columns {
  Lanes::Vector c0, c1, c2, c3;
};
PBF_INLINE Columns transposed(const Columns& rows) {
  constexpr int n = kLanes;
  const auto low01 = PBF_SHUFFLE(rows.c0, rows.c1, 0, n, 1, n + 1);
  const auto low23 = PBF_SHUFFLE(rows.c2, rows.c3, 0, n, 1, n + 1);
  const auto high01 = PBF_SHUFFLE(rows.c0, rows.c1, 2, n + 2, 3, n + 3);
  const auto high23 = PBF_SHUFFLE(rows.c2, rows.c3, 2, n + 2, 3, n + 3);
  return {PBF_SHUFFLE(low01, low23, 0, 1, n, n + 1), PBF_SHUFFLE(low01, low23, 2, 3, n + 2, n + 3),
          PBF_SHUFFLE(high01, high23, 0, 1, n, n + 1),
          PBF_SHUFFLE(high01, high23, 2, 3, n + 2, n + 3)};
}
#undef PBF_SHUFFLE

/// Four numbers from each of f(first), f(first + 4), … side by side. (Instructions by name:
/// put together from shuffles, GCC 12 does not let them read from memory.)
template <class F>
PBF_INLINE Lanes::Vector every_fourth([[maybe_unused]] int first, F&& f) {
#if defined(__AVX512F__)
  const __m512 one = _mm512_castps128_ps512(f(first));
  const __m512 two = _mm512_insertf32x4(one, f(first + 4), 1);
  const __m512 three = _mm512_insertf32x4(two, f(first + 8), 2);
  return _mm512_insertf32x4(three, f(first + 12), 3);
#elif defined(__AVX2__)
  return _mm256_insertf128_ps(_mm256_castps128_ps256(f(first)), f(first + 4), 1);
#else
  return f(first);
#endif
}

/// The records at f(lane), each in one load of 16 bytes: a gather instruction would fetch number by
/// number, at several times the cost.
template <class F>
PBF_INLINE RecordLanes records_at(F&& f) {
  const auto record = [&](int lane) PBF_LAMBDA_INLINE { return load<Four>(f(lane)); };
  const Columns c = transposed({every_fourth(0, record), every_fourth(1, record),
                                every_fourth(2, record), every_fourth(3, record)});
  return {{c.c0, c.c1, c.c2}, c.c3};
}
PBF_INLINE RecordLanes load_records(const Record* from) {
  return records_at([&](int lane) PBF_LAMBDA_INLINE { return from + lane; });
}
/// @param xyz  three numbers each, and one more behind the last
PBF_INLINE Vec3Lanes load_points(const Real* xyz) {
  return records_at([&](int lane) PBF_LAMBDA_INLINE { return xyz + 3 * lane; }).xyz;
}
/// @param entries  kLanes entries of a neighbor list: four times the places of particles
PBF_INLINE RecordLanes gather(const Record* records, const std::uint32_t* entries) {
  const auto* numbers = reinterpret_cast<const Real*>(records);
  return records_at([&](int lane) PBF_LAMBDA_INLINE { return numbers + entries[lane]; });
}

PBF_INLINE void store_records(Record* to, const Vec3Lanes& xyz, Lanes w) {
  const Columns r = transposed({xyz.x.v, xyz.y.v, xyz.z.v, w.v});
  const Lanes::Vector rows[4] = {r.c0, r.c1, r.c2, r.c3};
  for (int lane = 0; lane < kLanes; ++lane) {
    std::memcpy(to + lane, reinterpret_cast<const char*>(&rows[lane % 4]) + lane / 4 * 16, 16);
  }
}

}  // namespace pbf::PBF_ISA_NAMESPACE
