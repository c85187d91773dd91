#include "pbf/neighbors/cell_grid.hpp"

#include "pbf/core/fields.hpp"
#include "pbf/core/parallel.hpp"
#include "pbf/neighbors/reorder.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace pbf {
namespace {

/// Entries that a thread sorts at a time.
constexpr Index kBlock = 1 << 14;

struct Bounds {
  Eigen::Array3d lower = Eigen::Array3d::Constant(std::numeric_limits<double>::max());
  Eigen::Array3d upper = Eigen::Array3d::Constant(std::numeric_limits<double>::lowest());

  Bounds& operator+=(const Bounds& other) {
    lower = lower.min(other.lower);
    upper = upper.max(other.upper);
    return *this;
  }
};

Eigen::Array3d coordinates(const Record& x) { return {x.x, x.y, x.z}; }

Bounds bounds_of(const Records& x, Real h, int threads) {
  return parallel_sum<Bounds>(x.size(), threads, [&](Index i) {
    const Eigen::Array3d p = coordinates(x[i]);
    if (!CellGrid::reaches(vec3(x[i]), h)) {
      throw SimulationFailed("particle positions: " + to_text(vec3(x[i])) + " m; " +
                             CellGrid::reach_text(h) + "; use a smaller time step or a domain");
    }
    return Bounds{p, p};
  });
}

}  // namespace

bool CellGrid::reaches(const Vec3& x, Real h) {
  // False for what is no number as well.
  return (x.cast<double>().array().abs() <= kFarthestCell * static_cast<double>(h)).all();
}

std::string CellGrid::reach_text(Real h) {
  return "must be within " + to_text(kFarthestCell * static_cast<double>(h)) +
         " m (2^20 support radii) of the origin";
}

void CellGrid::build(const Records& x, Index particles, Real h, int threads) {
  const Index n = x.size();
  particles_ = particles;
  if (n > kMostParticles) {
    throw InvalidParameter("particles: " + std::to_string(n) + " are more than the " +
                           std::to_string(kMostParticles) + " that a grid can hold");
  }
  entries_.resize(static_cast<std::size_t>(n));
  order_.resize(entries_.size());
  keys_.clear();
  starts_.clear();
  if (n == 0) return;

  const double cell = static_cast<double>(h) * (1 + 1e-6);
  const Bounds bounds = bounds_of(x, h, threads);
  // One empty cell around the bounds: a row that leaves the grid then meets keys that no particle
  // has.
  const auto cells = [&](int axis) {
    return static_cast<std::uint64_t>((bounds.upper[axis] - bounds.lower[axis]) / cell) + 3;
  };
  stride_y_ = cells(0);
  stride_z_ = stride_y_ * cells(1);
  const std::uint64_t all_cells = stride_z_ * cells(2);
  ghost_keys_ = particles < n ? all_cells : 0;
  parallel_for(n, threads, [&](Index i) {
    const Eigen::Array3d c = (coordinates(x[i]) - bounds.lower) / cell;
    const auto key = (static_cast<std::uint64_t>(c[0]) + 1) +
                     (static_cast<std::uint64_t>(c[1]) + 1) * stride_y_ +
                     (static_cast<std::uint64_t>(c[2]) + 1) * stride_z_ +
                     (i < particles ? 0 : ghost_keys_);
    entries_[static_cast<std::size_t>(i)] = {key, static_cast<std::uint32_t>(i)};
  });
  sort_entries(all_cells + ghost_keys_, threads);
  find_cells(threads);
}

/// Radix sort from the lowest digit, which is stable: the order is a function of positions and
/// input order alone. Each block counts its digits, and from the counts of all follows where each
/// block puts each digit.
void CellGrid::sort_entries(std::uint64_t largest_key, int threads) {
  constexpr int kMostDigitBits = 11;
  using Places = std::array<std::uint32_t, 1 << kMostDigitBits>;
  const auto n = static_cast<Index>(entries_.size());
  std::vector<Places> places(static_cast<std::size_t>((n + kBlock - 1) / kBlock));
  scratch_.resize(entries_.size());
  const auto key_bits = static_cast<int>(std::bit_width(largest_key));
  // As few digits as possible, and those as short as possible: a scatter to fewer places.
  const int digits = std::max(1, (key_bits + kMostDigitBits - 1) / kMostDigitBits);
  const int digit_bits = (key_bits + digits - 1) / digits;
  const auto values = std::size_t{1} << digit_bits;
  for (int shift = 0; shift < key_bits; shift += digit_bits) {
    const auto digit = [&](Index k) {
      return (entries_[static_cast<std::size_t>(k)].key >> shift) & (values - 1);
    };
    parallel_chunks(n, threads, kBlock, [&](Index first, Index last) {
      Places& count = places[static_cast<std::size_t>(first / kBlock)];
      std::fill_n(count.begin(), values, 0);
      for (Index k = first; k < last; ++k) ++count[digit(k)];
    });
    std::uint32_t sum = 0;
    for (std::size_t d = 0; d < values; ++d) {
      for (Places& place : places) sum += std::exchange(place[d], sum);
    }
    parallel_chunks(n, threads, kBlock, [&](Index first, Index last) {
      Places& place = places[static_cast<std::size_t>(first / kBlock)];
      for (Index k = first; k < last; ++k) {
        scratch_[place[digit(k)]++] = entries_[static_cast<std::size_t>(k)];
      }
    });
    entries_.swap(scratch_);
  }
}

/// The cells that hold particles, from the sorted entries.
void CellGrid::find_cells(int threads) {
  const auto n = static_cast<Index>(entries_.size());
  const auto starts_cell = [&](Index k) {
    const auto e = static_cast<std::size_t>(k);
    return k == 0 || entries_[e].key != entries_[e - 1].key;
  };
  std::vector<std::size_t> first_cell(static_cast<std::size_t>((n + kBlock - 1) / kBlock));
  parallel_chunks(n, threads, kBlock, [&](Index first, Index last) {
    std::size_t count = 0;
    for (Index k = first; k < last; ++k) count += starts_cell(k) ? 1 : 0;
    first_cell[static_cast<std::size_t>(first / kBlock)] = count;
  });
  std::size_t cells = 0;
  for (std::size_t& first : first_cell) cells += std::exchange(first, cells);
  keys_.resize(cells);
  starts_.resize(cells + 1);
  starts_[cells] = static_cast<std::uint32_t>(n);
  parallel_chunks(n, threads, kBlock, [&](Index first, Index last) {
    std::size_t cell = first_cell[static_cast<std::size_t>(first / kBlock)];
    for (Index k = first; k < last; ++k) {
      const auto e = static_cast<std::size_t>(k);
      order_[e] = entries_[e].particle;
      if (!starts_cell(k)) continue;
      keys_[cell] = entries_[e].key;
      starts_[cell++] = static_cast<std::uint32_t>(k);
    }
  });
}

}  // namespace pbf
