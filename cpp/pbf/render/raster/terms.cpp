#include "pbf/render/raster/terms.hpp"

#include <algorithm>

namespace pbf::raster {

FrameTerms frame_terms(const FrameBlock& frame) {
  FrameTerms terms{.view = {},
                   .half_width = frame.lens[0],
                   .half_height = frame.lens[1],
                   .near = frame.lens[2],
                   .far = frame.lens[3],
                   .width = frame.size[0],
                   .height = frame.size[1],
                   .perspective = frame.size[2] > 0.5F,
                   .pixels_per_meter = frame.size[3]};
  std::copy(frame.view.begin(), frame.view.end(), terms.view);
  return terms;
}

Texels texels_of(const Map& map) { return {map.row(0), map.pitch(), map.width(), map.height()}; }

Scene scene_of(const FrameBlock& frame,
               const Environment& environment,
               const SunShadow& shadow,
               const Panorama* map) {
  const auto triple = [](const Vec3& v) { return Triple{v.x(), v.y(), v.z()}; };
  return {.frame = frame_terms(frame),
          .environment = environment,
          .shadow = {.first = shadow.casts_none() ? nullptr : shadow.transmittance.data(),
                     .width = shadow.width,
                     .height = shadow.height,
                     .center = triple(shadow.center),
                     .x = triple(shadow.x),
                     .y = triple(shadow.y)},
          .map = map == nullptr ? PanoramaTexels{} : map->texels()};
}

}  // namespace pbf::raster
