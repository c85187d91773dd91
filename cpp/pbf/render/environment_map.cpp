#include "pbf/render/environment_map.hpp"

#include "pbf/core/error.hpp"

#include <cmath>
#include <string>

namespace pbf {

void validate(const EnvironmentMap& map) {
  if (map.width < 1 || map.height < 1 || map.channels != 3) {
    throw InvalidParameter("environment_map: shape (" + std::to_string(map.height) + ", " +
                           std::to_string(map.width) + ", " + std::to_string(map.channels) +
                           "): must be (height, width, 3) with at least one pixel");
  }
  if (const std::size_t numbers = std::size_t{3} * map.width * map.height;
      map.data.size() != numbers) {
    throw InvalidParameter("environment_map: " + std::to_string(map.data.size()) +
                           " numbers of light; a map of this size has " + std::to_string(numbers));
  }
  for (std::size_t k = 0; k < map.data.size(); ++k) {
    if (!std::isfinite(map.data[k]) || map.data[k] < 0) {
      throw InvalidParameter("environment_map: row " + std::to_string(k / 3 / map.width) +
                             " holds " + std::to_string(map.data[k]) +
                             "; light must be finite and not negative");
    }
  }
}

}  // namespace pbf
