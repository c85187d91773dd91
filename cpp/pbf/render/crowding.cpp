#include "pbf/render/crowding.hpp"

#include "pbf/core/parallel.hpp"

#include <algorithm>

namespace pbf {
namespace {

constexpr Real kBody = 9;    // sum that makes a body of fluid
constexpr int kThreads = 0;  // all there are

/// Calls f(k, j, u) for each sorted particle k and each other one j within s, u = 1 - r²/s² > 0,
/// until f says that k has seen enough.
template <class F>
void for_each_pair(const CellGrid& grid, const Records& x, Real s, F&& f) {
  const Real inverse_s2 = 1 / (s * s);
  const auto visit = [&](std::uint32_t k, const Span& range) {
    for (std::uint32_t j = range.begin; j < range.end; ++j) {
      const Real dx = x[j].x - x[k].x, dy = x[j].y - x[k].y, dz = x[j].z - x[k].z;
      const Real u = 1 - (dx * dx + dy * dy + dz * dz) * inverse_s2;
      if (u > 0 && j != k && !f(k, j, u)) return false;
    }
    return true;
  };
  parallel_chunks(x.size(), kThreads, kChunk, [&](Index first, Index last) {
    grid.for_each_cell(first, last,
                       [&](std::uint32_t begin, std::uint32_t end, CellGrid::Ranges ranges) {
                         for (std::uint32_t k = begin; k < end; ++k) {
                           // Near rows of cells first: most particles need no other.
                           for (const std::size_t row : {4U, 1U, 3U, 5U, 7U, 0U, 2U, 6U, 8U}) {
                             if (!visit(k, ranges[row])) break;
                           }
                         }
                       });
  });
}

}  // namespace

void Crowding::find(const PointsView& positions, const Vec3& eye, Real s) {
  const Index n = positions.cols();
  const Real farthest = 0.5F * static_cast<Real>(kFarthestCell) * s;
  particles_.resize(n);
  near_.resize(n);
  ids_.clear();
  for (Index i = 0; i < n; ++i) {
    const Vec3 x = positions.col(i);
    particles_[i] = {x.x(), x.y(), x.z(), 1};
    const Vec3 from_eye = x - eye;
    if (s == 0 || !(from_eye.array().abs() <= farthest).all()) continue;
    near_[static_cast<Index>(ids_.size())] = {from_eye.x(), from_eye.y(), from_eye.z(), 0};
    ids_.push_back(static_cast<std::uint32_t>(i));
  }
  near_.resize(static_cast<Index>(ids_.size()));
  if (near_.size() == 0) return;
  grid_.build(near_, s, kThreads);
  sorted_.resize(near_.size());
  const auto& order = grid_.order();
  for (Index k = 0; k < near_.size(); ++k) sorted_[k] = near_[order[static_cast<std::size_t>(k)]];
  for_each_pair(grid_, sorted_, s, [&](std::uint32_t k, std::uint32_t, Real u) {
    sorted_[k].w += u * u;
    return sorted_[k].w < kBody;
  });
  const auto crowding = [&](Index k) -> Real& {
    return particles_[ids_[order[static_cast<std::size_t>(k)]]].w;
  };
  for (Index k = 0; k < sorted_.size(); ++k) {
    crowding(k) = sorted_[k].w = std::min(sorted_[k].w, kBody);
  }
  for_each_pair(grid_, sorted_, s, [&](std::uint32_t k, std::uint32_t j, Real u) {
    Real& c = crowding(k);
    c = std::max(c, std::min(1.5F * u, Real{1}) * sorted_[j].w);
    return c < kBody;
  });
  for (Index k = 0; k < sorted_.size(); ++k) crowding(k) /= kBody;
}

}  // namespace pbf
