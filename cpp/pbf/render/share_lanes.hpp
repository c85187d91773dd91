#pragma once

#include "pbf/core/lanes.hpp"
#include "pbf/render/shares.hpp"

namespace pbf::PBF_ISA_NAMESPACE {

/// Whether the four cells around a point, x and y in cells from the first one's middle, are in a
/// grid.
PBF_INLINE Mask is_within(Lanes x, Lanes y, Ints width, Ints height) {
  const auto last = [](Ints size) PBF_LAMBDA_INLINE {
    return Lanes(__builtin_convertvector(size - 1, Lanes::Vector));
  };
  return (Lanes(0.0F) <= x) & (Lanes(0.0F) <= y) & (x < last(width)) & (y < last(height));
}

/// What particles at these points add, those that are `inside`; the others nothing.
PBF_INLINE void store_shares(
    Shares& shares, Index first, Lanes x, Lanes y, Ints width, Mask inside, Lanes amount) {
  const Lanes column = floor(select(inside, x, 0.0F)), row = floor(select(inside, y, 0.0F));
  const Ints cell =
      __builtin_convertvector(row.v, Ints) * width + __builtin_convertvector(column.v, Ints);
  std::memcpy(shares.cell + first, &cell, sizeof cell);
  store(shares.right + first, x - column);
  store(shares.up + first, y - row);
  store(shares.amount + first, select(inside, amount, 0.0F));
}

}  // namespace pbf::PBF_ISA_NAMESPACE
