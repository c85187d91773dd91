#pragma once

#include "pbf/core/real.hpp"
#include "pbf/core/records.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <vector>

namespace pbf {

/// The rows of kChunk particles, or fewer at the end, as a loop over vectors reads them: a slice
/// for every `lanes` consecutive particles, in slot k of a slice the k-th entries of its rows side
/// by side. ("Sliced ELLPACK" [MLA10]: rows of a slice are as long as its longest, filled up with
/// entries that contribute nothing; a lane adds up its row in order, whatever `lanes` is.)
template <class T>
struct SliceView {
  const T* entries = nullptr;           ///< slots × numbers per slot
  const std::uint32_t* ends = nullptr;  ///< of each slice, in slots
};

/// Rows of different lengths, one per particle, in slices. Every chunk of kChunk particles has a
/// buffer of its own, so that threads can build them at once; it keeps its memory from step to
/// step.
template <class T>
class SlicedRows {
 public:
  struct Chunk {
    std::vector<T> entries;
    std::array<std::uint32_t, static_cast<std::size_t>(kChunk / 4)> ends{};

    /// Room for so many entries, with little to spare: lists are most of a simulation's memory.
    T* reserve(std::size_t count) {
      if (entries.size() < count) entries = std::vector<T>(count + count / 16);
      return entries.data();
    }
  };

  /// @param lanes  particles in a slice
  void resize(Index n, int lanes) {
    n_ = n;
    lanes_ = lanes;
    chunks_.resize(static_cast<std::size_t>((n + kChunk - 1) / kChunk));
  }
  /// Lays out the slices of the chunk that starts at particle `first`, from the lengths of its
  /// rows; returns its number of slots.
  std::uint32_t lay_out(Index first, std::span<const std::uint32_t> lengths) {
    auto end = chunk(first).ends.begin();
    std::uint32_t slots = 0;
    for (auto rest = lengths; !rest.empty(); ++end) {
      const auto slice = rest.first(std::min(rest.size(), static_cast<std::size_t>(lanes_)));
      slots += *std::max_element(slice.begin(), slice.end());
      *end = slots;
      rest = rest.subspan(slice.size());
    }
    return slots;
  }
  [[nodiscard]] Index size() const { return n_; }
  [[nodiscard]] int lanes() const { return lanes_; }
  /// The chunk that particle i is in.
  [[nodiscard]] Chunk& chunk(Index i) { return chunks_[static_cast<std::size_t>(i / kChunk)]; }
  [[nodiscard]] const Chunk& chunk(Index i) const {
    return chunks_[static_cast<std::size_t>(i / kChunk)];
  }
  [[nodiscard]] SliceView<T> view(Index first) const {
    return {chunk(first).entries.data(), chunk(first).ends.data()};
  }
  /// Slots [begin, end) of the slice that holds particle i.
  struct Slots {
    std::uint32_t begin, end;
  };
  [[nodiscard]] Slots slots(Index i) const {
    const auto slice = static_cast<std::size_t>(i % kChunk / lanes_);
    const auto& ends = chunk(i).ends;
    return {slice == 0 ? 0 : ends[slice - 1], ends[slice]};
  }
  [[nodiscard]] std::size_t bytes() const {
    std::size_t sum = 0;
    for (const Chunk& c : chunks_) sum += sizeof(Chunk) + c.entries.size() * sizeof(T);
    return sum;
  }

 private:
  Index n_ = 0;
  int lanes_ = 4;
  std::vector<Chunk> chunks_;
};

}  // namespace pbf
