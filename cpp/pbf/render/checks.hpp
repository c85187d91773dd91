#pragma once

#include "pbf/core/types.hpp"
#include "pbf/render/camera.hpp"
#include "pbf/render/params.hpp"

namespace pbf {

// Of what whoever asks for a picture says; InvalidParameter says what is wrong.

/// @param name  "width" or "height"   @return side
int checked_side(int side, const char* name);
/// Of layers.
void require_sound(const PointsView& positions, const Camera& camera, const RenderParams& params);
/// Of a picture.
/// @param values   one for each particle, or none
/// @param has_map  whether the renderer has an environment map
void require_sound(const PointsView& positions,
                   const Camera& camera,
                   const RenderParams& params,
                   const ScalarsView& values,
                   bool has_map);

}  // namespace pbf
