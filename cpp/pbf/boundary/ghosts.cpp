#include "pbf/boundary/ghosts.hpp"

#include "pbf/core/parallel.hpp"

namespace pbf {
namespace {

/// What is added to a coordinate to get it and its images within h of the box.
struct Shifts {
  std::array<Real, 3> by{};  // the first is the coordinate itself
  int count = 1;
};

Shifts shifts(const Box& box, int axis, Real x, Real h) {
  Shifts result;
  if (!box.periodic[static_cast<std::size_t>(axis)]) return result;
  const Real period = box.upper[axis] - box.lower[axis];
  const auto add_if_near = [&](Real shift) {
    // In double the distance is exact: no pair within h is missed by a rounding.
    const auto image = static_cast<double>(x + shift);
    const auto reach = static_cast<double>(h);
    if (image > static_cast<double>(box.lower[axis]) - reach &&
        image < static_cast<double>(box.upper[axis]) + reach) {
      result.by[static_cast<std::size_t>(result.count++)] = shift;
    }
  };
  add_if_near(period);
  add_if_near(-period);
  return result;
}

/// f(shift) for every image of x within h of the box but x itself.
template <class F>
void for_each_image(const Box& box, const Record& x, Real h, F&& f) {
  const std::array<Shifts, 3> axes{shifts(box, 0, x.x, h), shifts(box, 1, x.y, h),
                                   shifts(box, 2, x.z, h)};
  for (int c = 0; c < axes[2].count; ++c) {
    for (int b = 0; b < axes[1].count; ++b) {
      for (int a = 0; a < axes[0].count; ++a) {
        if (a + b + c > 0) f(std::array<Real, 3>{axes[0].by[a], axes[1].by[b], axes[2].by[c]});
      }
    }
  }
}

}  // namespace

void Ghosts::append(const std::optional<Box>& box, Real h, Records& x, int threads) {
  particles_ = x.size();
  ghosts_.clear();
  if (!box || !box->is_periodic()) return;
  std::vector<std::vector<Ghost>> found(static_cast<std::size_t>((x.size() + kChunk - 1) / kChunk));
  parallel_chunks(x.size(), threads, kChunk, [&](Index first, Index last) {
    for (Index i = first; i < last; ++i) {
      for_each_image(*box, x[i], h, [&](const std::array<Real, 3>& shift) {
        found[static_cast<std::size_t>(first / kChunk)].push_back(
            {static_cast<std::uint32_t>(i), shift});
      });
    }
  });
  for (const auto& chunk : found) ghosts_.insert(ghosts_.end(), chunk.begin(), chunk.end());
  refresh_positions(x, threads);
}

void Ghosts::reorder(const std::vector<std::uint32_t>& order, int threads) {
  if (ghosts_.empty()) return;
  place_.resize(static_cast<std::size_t>(particles_));
  parallel_for(particles_, threads, [&](Index k) {
    place_[order[static_cast<std::size_t>(k)]] = static_cast<std::uint32_t>(k);
  });
  before_ = ghosts_;
  parallel_for(size(), threads, [&](Index k) {
    const Index from = order[static_cast<std::size_t>(particles_ + k)] - particles_;
    const Ghost& ghost = before_[static_cast<std::size_t>(from)];
    ghosts_[static_cast<std::size_t>(k)] = {place_[ghost.source], ghost.shift};
  });
}

/// values[ghost] = f(record of its particle, shift)
template <class F>
void Ghosts::refresh_with(Records& values, int threads, F&& f) const {
  if (ghosts_.empty()) return;
  values.resize(particles_ + size());
  parallel_for(size(), threads, [&](Index k) {
    const Ghost& ghost = ghosts_[static_cast<std::size_t>(k)];
    values[particles_ + k] = f(values[ghost.source], ghost.shift);
  });
}

void Ghosts::refresh(Records& values, int threads) const {
  refresh_with(values, threads, [](const Record& a, const auto&) { return a; });
}

void Ghosts::refresh_positions(Records& x, int threads) const {
  refresh_with(x, threads, [](const Record& a, const auto& shift) {
    return Record{a.x + shift[0], a.y + shift[1], a.z + shift[2], a.w};
  });
}

void wrap(const std::optional<Box>& box, Records& x, int threads) {
  if (!box || !box->is_periodic()) return;
  parallel_for(x.size(), threads, [&](Index i) {
    x[i] = {box->wrap(0, x[i].x), box->wrap(1, x[i].y), box->wrap(2, x[i].z), x[i].w};
  });
}

}  // namespace pbf
