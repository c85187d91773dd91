#pragma once

#include "pbf/boundary/box.hpp"
#include "pbf/core/records.hpp"

#include <optional>
#include <vector>

namespace pbf {

/// Periodic axes for loops that know nothing of them. The particles within h of a periodic face
/// have ghosts: copies a period farther, beyond the opposite face (in corners up to seven, one for
/// each combination of axes). Ghosts stand behind the particles in every array of records that is
/// read at neighbors, and neighbor lists may name them; they have no lists of their own, so no
/// sweep works for them. Whoever has changed such an array refreshes the ghosts in it from their
/// particles. Without periodic axes there are none, and every call returns at once.
///
/// A particle has at most one image within h of another, since a period is at least 2 h.
class Ghosts {
 public:
  /// Finds who has ghosts among the particles at x, which lie in the box, and puts the ghosts
  /// behind them.
  void append(const std::optional<Box>& box, Real h, Records& x, int threads);
  /// Takes the particles, and the ghosts behind them, to have been brought into this order (place
  /// → index before).
  void reorder(const std::vector<std::uint32_t>& order, int threads);

  /// Records that go with their particle unchanged: velocities.
  void refresh(Records& values, int threads) const;
  /// Records whose x, y, z are a position: the ghost's is a period farther.
  void refresh_positions(Records& x, int threads) const;

  [[nodiscard]] Index size() const { return static_cast<Index>(ghosts_.size()); }
  /// The particle whose k-th ghost this is.
  [[nodiscard]] Index source(Index k) const { return ghosts_[static_cast<std::size_t>(k)].source; }
  [[nodiscard]] std::size_t bytes() const {
    return (ghosts_.capacity() + before_.capacity()) * sizeof(Ghost) +
           place_.capacity() * sizeof(std::uint32_t);
  }

 private:
  struct Ghost {
    std::uint32_t source;
    std::array<Real, 3> shift;  // [m]
  };
  template <class F>
  void refresh_with(Records& values, int threads, F&& f) const;

  Index particles_ = 0;
  std::vector<Ghost> ghosts_, before_;
  std::vector<std::uint32_t> place_;
};

/// Brings positions back into [lower, upper) along the periodic axes of the box.
void wrap(const std::optional<Box>& box, Records& x, int threads);

}  // namespace pbf
