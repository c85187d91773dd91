#pragma once

#include "pbf/core/records.hpp"
#include "pbf/render/environment_map.hpp"
#include "pbf/render/raster/scene.hpp"

namespace pbf::raster {

/// An environment map with its mipmaps, each the mean of four texels of the one before.
class Panorama {
 public:
  explicit Panorama(const EnvironmentMap& map);
  [[nodiscard]] PanoramaTexels texels() const;

 private:
  struct Level {
    int width, height;
    std::vector<Record> texels;  // row 0 below
  };
  std::vector<Level> levels_;
};

}  // namespace pbf::raster
