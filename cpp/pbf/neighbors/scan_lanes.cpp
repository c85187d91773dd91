// Compiled once per instruction set (cpp/CMakeLists.txt).
#include "pbf/core/lanes.hpp"
#include "pbf/neighbors/scan.hpp"

#if defined(__AVX2__) && !defined(__AVX512F__)
#include <array>
#endif

namespace pbf::PBF_ISA_NAMESPACE {
namespace {

using Entries = std::uint32_t __attribute__((vector_size(4 * kLanes)));

PBF_INLINE void store(std::uint32_t* to, Entries value) { std::memcpy(to, &value, sizeof value); }

std::uint32_t collect(const Record* x, const Span* ranges, std::size_t count, Candidates to) {
  const Entries lanes = reinterpret_cast<Entries>(lane_numbers());
  std::uint32_t n = 0;
  for (std::size_t k = 0; k < count; ++k) {
    for (std::uint32_t j = ranges[k].begin; j < ranges[k].end; j += kLanes) {
      const RecordLanes at = load_records(x + j);
      store(to.x + n, at.xyz.x);
      store(to.y + n, at.xyz.y);
      store(to.z + n, at.xyz.z);
      store(to.entry + n, 4 * (lanes + j));
      // What was read beyond the range is written over by the next.
      const std::uint32_t left = ranges[k].end - j;
      n += left < kLanes ? left : kLanes;
    }
  }
  store(to.x + n, Lanes(Records::kFar));
  store(to.y + n, Lanes(Records::kFar));
  store(to.z + n, Lanes(Records::kFar));
  return n;
}

/// Writes the entries whose lane is set, one behind the other; returns the place behind the last.
/// May write kLanes entries.
#if defined(__AVX512F__)
PBF_INLINE std::uint32_t* compress(Mask mask, Entries entries, std::uint32_t* out) {
  const __mmask16 bits = _mm512_movepi32_mask(reinterpret_cast<__m512i>(mask.v));
  _mm512_storeu_si512(out, _mm512_maskz_compress_epi32(bits, reinterpret_cast<__m512i>(entries)));
  return out + __builtin_popcount(bits);
}
#elif defined(__AVX2__)
/// For each set of lanes their numbers in order.
struct Orders {
  alignas(32) std::uint32_t lanes[256][8];
};
constexpr Orders kOrders = [] {
  Orders orders{};
  for (int bits = 0; bits < 256; ++bits) {
    int n = 0;
    for (std::uint32_t lane = 0; lane < 8; ++lane) {
      if ((bits >> lane & 1) != 0) orders.lanes[bits][n++] = lane;
    }
  }
  return orders;
}();
PBF_INLINE std::uint32_t* compress(Mask mask, Entries entries, std::uint32_t* out) {
  const auto bits = static_cast<unsigned>(_mm256_movemask_ps(reinterpret_cast<__m256>(mask.v)));
  const auto order = _mm256_load_si256(reinterpret_cast<const __m256i*>(kOrders.lanes[bits]));
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(out),
                      _mm256_permutevar8x32_epi32(reinterpret_cast<__m256i>(entries), order));
  return out + __builtin_popcount(bits);
}
#else
PBF_INLINE std::uint32_t* compress(Mask mask, Entries entries, std::uint32_t* out) {
  for (int lane = 0; lane < kLanes; ++lane) {
    *out = entries[lane];
    out -= mask.v[lane];  // −1 where it is set
  }
  return out;
}
#endif

std::uint32_t* rows(const Record* x,
                    std::uint32_t begin,
                    std::uint32_t end,
                    Candidates candidates,
                    std::uint32_t self,
                    Real h2,
                    std::uint32_t filler,
                    std::uint32_t* out,
                    std::uint32_t* lengths) {
  for (std::uint32_t i = begin; i < end; ++i, ++self) {
    const Vec3Lanes x_i{x[i].x, x[i].y, x[i].z};
    // A particle is not its own neighbor: for the moment it is far away.
    candidates.x[self] = Records::kFar;
    const std::uint32_t* row = out;
    for (std::uint32_t k = 0; k < candidates.count; k += kLanes) {
      const Vec3Lanes r =
          x_i - Vec3Lanes{load_lanes(candidates.x + k), load_lanes(candidates.y + k),
                          load_lanes(candidates.z + k)};
      out = compress(dot(r, r) < h2, load<Entries>(candidates.entry + k), out);
    }
    candidates.x[self] = x[i].x;
    const auto length = static_cast<std::uint32_t>(out - row);
    lengths[i - begin] = length;
    for (int k = 0; k < 4; ++k) out[k] = filler;
    out += (4 - length % 4) % 4;
  }
  return out;
}

void pack(const std::uint32_t* const* rows,
          const std::uint32_t* lengths,
          std::uint32_t slots,
          std::uint32_t filler,
          std::uint32_t* out) {
  const std::uint32_t fillers[4] = {filler, filler, filler, filler};
  for (std::uint32_t slot = 0; slot < slots; slot += 4) {
    const auto four = [&](int lane) PBF_LAMBDA_INLINE {
      return load<Four>(slot < lengths[lane] ? rows[lane] + slot : fillers);
    };
    const Columns c = transposed({every_fourth(0, four), every_fourth(1, four),
                                  every_fourth(2, four), every_fourth(3, four)});
    store(out, reinterpret_cast<Entries>(c.c0));
    store(out + kLanes, reinterpret_cast<Entries>(c.c1));
    store(out + 2 * kLanes, reinterpret_cast<Entries>(c.c2));
    store(out + 3 * kLanes, reinterpret_cast<Entries>(c.c3));
    out += 4 * kLanes;
  }
}

}  // namespace

const Scan& scan() {
  static constexpr Scan table{kLanes, collect, rows, pack};
  return table;
}

}  // namespace pbf::PBF_ISA_NAMESPACE
