#include "pbf/render/checks.hpp"

#include "pbf/core/error.hpp"
#include "pbf/core/finite.hpp"
#include "pbf/core/parallel.hpp"
#include "pbf/render/point_block.hpp"

#include <atomic>
#include <cmath>
#include <string>
#include <vector>

namespace pbf {
namespace {

void require_finite(const PointsView& positions) {
  constexpr Index kBlock = 1 << 12;
  std::atomic<bool> sound{true};
  parallel_chunks(positions.cols(), 0, kBlock, [&](Index first, Index last) {
    const Real* block = point_block(positions, first, last);
    if (!all_finite({block, static_cast<std::size_t>(3 * (last - first))}, 1)) sound = false;
  });
  if (sound) return;
  Index first = 0;
  while (positions.col(first).allFinite()) ++first;
  throw InvalidParameter("positions: particle " + std::to_string(first) +
                         " is not finite; every coordinate must be");
}

void require_values(const ScalarsView& values, Index particles) {
  if (values.size() != 0 && values.size() != particles) {
    throw InvalidParameter("values: " + std::to_string(values.size()) + " for " +
                           std::to_string(particles) + " particles; there must be one for each");
  }
  for (Index i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i])) {
      throw InvalidParameter("values: that of particle " + std::to_string(i) +
                             " is not finite; every one must be");
    }
  }
}

void require_map(const RenderParams& params, bool has_map) {
  if (!params.shows_map() || has_map) return;
  throw InvalidParameter(
      "RenderParams.background or reflection = \"map\": the renderer has no environment map; "
      "give it one");
}

}  // namespace

int checked_side(int side, const char* name) {
  if (side < 1) {
    throw InvalidParameter(std::string(name) + " = " + std::to_string(side) +
                           " pixels: must be at least 1");
  }
  return side;
}

void require_sound(const PointsView& positions, const Camera& camera, const RenderParams& params) {
  validate(camera);
  validate(params);
  require_finite(positions);
}

void require_sound(const PointsView& positions,
                   const Camera& camera,
                   const RenderParams& params,
                   const ScalarsView& values,
                   bool has_map) {
  require_sound(positions, camera, params);
  require_values(values, positions.cols());
  require_map(params, has_map);
}

}  // namespace pbf
