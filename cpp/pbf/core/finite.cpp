#include "pbf/core/finite.hpp"

#include "pbf/core/parallel.hpp"

#include <atomic>
#include <bit>

namespace pbf {
namespace {

/// Adding to the exponents, of which only infinities and what is no number have all bits set,
/// reaches the sign: no branch, so the compiler makes vectors of it.
bool block_is_finite(std::span<const Real> numbers) {
  std::uint32_t reached = 0;
  for (const Real number : numbers) {
    reached |= (std::bit_cast<std::uint32_t>(number) & 0x7F800000U) + 0x00800000U;
  }
  return reached >> 31 == 0;
}

}  // namespace

bool all_finite(std::span<const Real> numbers, int threads) {
  constexpr Index kBlock = 1 << 14;
  std::atomic<bool> finite{true};
  parallel_chunks(std::ssize(numbers), threads, kBlock, [&](Index first, Index last) {
    if (!block_is_finite(numbers.subspan(first, last - first))) finite = false;
  });
  return finite;
}

}  // namespace pbf
