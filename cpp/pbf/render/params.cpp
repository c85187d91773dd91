#include "pbf/render/params.hpp"

#include <cmath>
#include <numbers>

namespace pbf {

Real RenderParams::volume_in_force() const {
  const Real sphere = 4.0F / 3.0F * std::numbers::pi_v<Real> * radius * radius * radius;
  return particle_volume.value_or(sphere);
}

Real RenderParams::neighbor_distance() const {
  if (!drop_radius && anisotropy == 0) return 0;
  return 2.4F * (particle_volume ? std::cbrt(*particle_volume) : radius);
}

void RenderParams::check_together(Faults& faults) const {
  if (drop_radius && *drop_radius > radius) {
    faults.add("drop_radius", *drop_radius, "m", "must not exceed radius = " + to_text(radius));
  }
  if (color_range && !((*color_range)[0] < (*color_range)[1])) {
    faults.add("color_range", *color_range, "", "the first must be less than the second");
  }
  if (!legend.empty() && colormap == Colormap::shuffled) {
    faults.add("legend", legend, "", "the colors of shuffled have no order; leave it empty");
  }
  if (!(up.norm() > 0)) faults.add("up", up, "", "must not be zero; (0, 1, 0) if y points up");
  if (!(sun_direction.norm() > 0)) {
    faults.add("sun_direction", sun_direction, "", "must not be zero; it points towards the sun");
  }
  if (tank_lower.has_value() != tank_upper.has_value()) {
    const char* missing = tank_lower ? "tank_upper" : "tank_lower";
    faults.add(missing, tank_lower ? tank_upper : tank_lower, "m",
               "must be given together with the opposite corner");
  } else if (tank_lower && !(tank_lower->array() < tank_upper->array()).all()) {
    faults.add("tank_upper", *tank_upper, "m",
               "must exceed tank_lower = " + to_text(*tank_lower) + " on every axis");
  }
}

}  // namespace pbf
