#pragma once

#include <cstddef>
#include <cstdint>

namespace pbf {

using Real = float;
using Index = std::ptrdiff_t;

/// Particles handed to a thread at a time: large enough to hide the scheduler, small enough to
/// balance a splash.
inline constexpr Index kChunk = 256;

constexpr Real square(Real a) { return a * a; }

}  // namespace pbf
