#pragma once

#include "pbf/core/real.hpp"

#include <utility>
#include <vector>

namespace pbf {

/// A point or vector of a particle with one number more: what a loop over neighbors fetches in a
/// single load.
struct alignas(16) Record {
  Real x = 0, y = 0, z = 0, w = 0;
};

/// Floats in the widest vector that any instruction set has.
inline constexpr Index kMostLanes = 16;

/// A record per particle. Behind the last stand records of no particle, so that loops may work on
/// whole vectors, and one that is farther from everything than any support radius: the filler, to
/// which neighbor lists point where a row has no entry.
class Records {
 public:
  Records() = default;
  explicit Records(Index n) { resize(n); }
  /// Keeps the first records.
  void resize(Index n) {
    if (n == n_ && !records_.empty()) return;
    n_ = n;
    records_.resize(static_cast<std::size_t>(n));
    records_.resize(static_cast<std::size_t>(filler(n) + 1 + kMostLanes));
    records_[static_cast<std::size_t>(filler(n))] = {kFar, kFar, kFar, 0};
  }
  [[nodiscard]] Index size() const { return n_; }
  [[nodiscard]] Record* data() { return records_.data(); }
  [[nodiscard]] const Record* data() const { return records_.data(); }
  [[nodiscard]] Record& operator[](Index i) { return records_[static_cast<std::size_t>(i)]; }
  [[nodiscard]] const Record& operator[](Index i) const {
    return records_[static_cast<std::size_t>(i)];
  }
  void swap(Records& other) noexcept {
    records_.swap(other.records_);
    std::swap(n_, other.n_);
  }

  /// Place of the filler behind n records.
  static constexpr Index filler(Index n) { return (n + kMostLanes - 1) / kMostLanes * kMostLanes; }
  /// Its coordinates [m]; the square of its distance is finite in float32.
  static constexpr Real kFar = 1e15F;

 private:
  Index n_ = 0;
  std::vector<Record> records_;
};

}  // namespace pbf
