// tank.glsl: where the tank's walls and the floor are, and what they do to the surface.
uniform float u_radius;  // of a sprite [m]

float tank_bottom() { return min(dot(u_tank_lower, u_up), dot(u_tank_upper, u_up)); }

// Whether there is air below the tank, as beyond its walls.
bool bottom_is_wall() {
  return u_has_floor == 0 || tank_bottom() > u_floor_height + 0.5 * u_radius;
}

// How far it is to the tank's wall from inside. A bottom on the floor and the surface are none.
float distance_to_wall(vec3 point, vec3 direction, out vec3 outward) {
  vec3 side = mix(vec3(-1.0), vec3(1.0), step(0.0, direction));
  vec3 face = mix(u_tank_lower, u_tank_upper, step(0.0, direction));
  vec3 way = (face - clamp(point, u_tank_lower, u_tank_upper)) / (side * max(abs(direction), 1e-6));
  bool goes_down = bottom_is_wall() && dot(direction, u_up) < 0.0;
  way += goes_down ? vec3(0.0) : NOWHERE * step(0.9, abs(u_up));
  float nearest = min(way.x, min(way.y, way.z));
  outward = side * vec3(lessThanEqual(way, vec3(nearest)));
  return u_has_tank == 1 ? nearest : NOWHERE;
}

// How far it is to the floor or the tank's bottom that stands on it.
float distance_to_ground(vec3 point, vec3 direction) {
  float down = -dot(direction, u_up);
  bool ends = u_has_tank == 1 && !bottom_is_wall() && down > 1e-4;
  float to_bottom = ends ? max(dot(point, u_up) - tank_bottom(), 0.0) / down : NOWHERE;
  return min(to_bottom, distance_to_floor(point, direction));
}

// Fluid that stands on the floor does not curl in below it, as its lowest spheres do.
vec3 upright_at_floor(vec3 n, vec3 position) {
  vec3 up = mat3(u_view) * u_up;
  float height = u_has_floor == 1 ? height_above_floor(position) / u_radius : NOWHERE;
  float nearness = 1.0 - smoothstep(1.0, 3.0, height);
  return normalize(n - nearness * min(dot(n, up), 0.0) * up);
}

// A body's spheres stick out of the tank by less than their radius, but fluid ends at its walls.
// What a ray meets before a wall is moved there, and what it meets behind one is not there. Fluid
// farther outside stays where it is.
// @param back  length of the ray's way to the far side [m]
// @return      share of the pixel that is fluid
float cut_at_walls(inout vec3 p, vec3 view, float back, float body, inout vec3 n) {
  vec3 point = u_eye + to_world(p);
  vec3 direction = to_world(view);
  vec3 is_up = step(0.9, abs(u_up));
  bool goes_down = dot(direction, u_up) < 0.0;
  vec3 opens_near = goes_down || !bottom_is_wall() ? is_up : vec3(0.0);
  vec3 opens_far = goes_down && bottom_is_wall() ? vec3(0.0) : is_up;
  vec3 outside = (1.0 - is_up) * max(u_tank_lower - point, point - u_tank_upper);
  bool is_outside = max(outside.x, max(outside.y, outside.z)) > u_radius;
  if (u_has_tank == 0 || body < 1.0 || is_outside) return 1.0;
  vec3 ahead = step(0.0, direction);
  vec3 speed = mix(vec3(-1.0), vec3(1.0), ahead) * max(abs(direction), 1e-5);
  vec3 to_near = (mix(u_tank_upper, u_tank_lower, ahead) - point) / speed - NOWHERE * opens_near;
  vec3 to_far = (mix(u_tank_lower, u_tank_upper, ahead) - point) / speed + NOWHERE * opens_far;
  float enters = max(to_near.x, max(to_near.y, to_near.z));
  float leaves = min(to_far.x, min(to_far.y, to_far.z));
  // It stands at a wall as at the floor: up to the glass, without curling away from it. A surface
  // that faces the viewer through a near wall keeps its normal.
  vec3 world_n = to_world(n);
  float lies = smoothstep(0.4, 0.8, abs(dot(world_n, u_up)));
  vec3 far = (1.0 - smoothstep(2.0, 5.0, to_far * abs(speed) / u_radius)) * sign(speed);
  vec3 near = (1.0 - smoothstep(2.0, 5.0, -to_near * abs(speed) / u_radius)) * -sign(speed);
  vec3 flat_n = world_n - far * max(world_n * far, 0.0) - lies * near * max(world_n * near, 0.0);
  n = normalize(mat3(u_view) * (flat_n - 1e-6 * direction));
  // Filters round off the edge between two walls; one behind the viewer is not seen through.
  float inside = -enters * dot(abs(speed), vec3(greaterThanEqual(to_near, vec3(enters))));
  if (inside < (1.0 - lies) * u_radius && p.z + enters * view.z < 0.0) {
    p += enters * view;
    n = mat3(u_view) * (-sign(speed) * vec3(greaterThanEqual(to_near, vec3(enters))));
    leaves = min(leaves, back) - enters;
  }
  return clamp(0.5 + 0.5 * leaves * pixels_per_meter(-p.z), 0.0, 1.0);
}
