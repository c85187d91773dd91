#pragma once

#include "pbf/render/frame_block.hpp"
#include "pbf/render/raster/map.hpp"
#include "pbf/render/raster/panorama.hpp"
#include "pbf/render/raster/scene.hpp"
#include "pbf/render/sun_shadow.hpp"

namespace pbf::raster {

// For the loops that are compiled for several instruction sets (scene.hpp).
FrameTerms frame_terms(const FrameBlock& frame);
Texels texels_of(const Map& map);
/// @param map  null: none   The shadow and the map must outlive what is given.
Scene scene_of(const FrameBlock& frame,
               const Environment& environment,
               const SunShadow& shadow,
               const Panorama* map);

}  // namespace pbf::raster
