#include "pbf/render/raster/layers.hpp"

#include "pbf/render/affine_depth.hpp"

namespace pbf::raster {

Pixels<float> pixels(const Map& map) {
  Pixels<float> result{map.width(), map.height(), 1, {}};
  result.data.reserve(static_cast<std::size_t>(result.width) * result.height);
  for (int y = result.height - 1; y >= 0; --y) {
    result.data.insert(result.data.end(), map.row(y), map.row(y) + result.width);
  }
  return result;
}

Pixels<float> pixels(const NormalMaps& maps) {
  Pixels<float> result{maps.x.width(), maps.x.height(), 3, {}};
  result.data.resize(static_cast<std::size_t>(result.width) * result.height * 3);
  float* to = result.data.data();
  for (int y = result.height - 1; y >= 0; --y) {
    for (int x = 0; x < result.width; ++x) {
      for (const Map* map : {&maps.x, &maps.y, &maps.z}) *to++ = map->row(y)[x];
    }
  }
  return result;
}

Pixels<float> depth_pixels(const Map& map, const Camera& camera) {
  Pixels<float> result = pixels(map);
  for (float& a : result.data) a = depth_or_none(a, camera.orthographic);
  return result;
}

}  // namespace pbf::raster
