#pragma once

#include "pbf/core/isa.hpp"
#include "pbf/core/records.hpp"

namespace pbf {

/// Consecutive places in the sorted order.
struct Span {
  std::uint32_t begin, end;
};

/// Particles that may be near those of a cell, number by number in consecutive memory. Behind the
/// last there is room for kMostLanes more.
struct Candidates {
  Real *x, *y, *z;
  std::uint32_t* entry;  ///< four times the particle's place
  std::uint32_t count;
};

/// The inner loops of the neighbor search, for one instruction set.
struct Scan {
  int lanes;  ///< particles in a slice
  /// Copies the particles of the ranges; returns how many. (Nine short loops per particle would
  /// cost more than the one long loop that this allows.)
  std::uint32_t (*collect)(const Record* x, const Span* ranges, std::size_t count, Candidates to);
  /// For the particles [begin, end), which are the candidates from number `self` on: writes the
  /// entries of the others within sqrt(h2) in order of candidates, row after row, each from a
  /// multiple of four on and with four fillers behind it, and the rows' lengths. `out` needs room
  /// for count + kMostLanes + 8 entries a row. Returns the end of the last row.
  std::uint32_t* (*rows)(const Record* x,
                         std::uint32_t begin,
                         std::uint32_t end,
                         Candidates candidates,
                         std::uint32_t self,
                         Real h2,
                         std::uint32_t filler,
                         std::uint32_t* out,
                         std::uint32_t* lengths);
  /// Puts the rows of a slice side by side; writes up to three slots more than the longest has.
  void (*pack)(const std::uint32_t* const* rows,
               const std::uint32_t* lengths,
               std::uint32_t slots,
               std::uint32_t filler,
               std::uint32_t* out);
};

const Scan& scan(Isa isa);

}  // namespace pbf
