// environment.glsl: what stands behind and around the fluid, as a function of a ray: a sky with a sun, and a
// floor. World space, meters, linear colors. An analytic scene has an answer for every refracted and reflected
// ray, so nothing in front of the fluid can bleed in and there are no halos.
uniform vec3 u_up;              // unit vector
uniform vec3 u_sun;             // unit vector towards the sun
uniform int u_plain;            // 1: one color in all directions
uniform vec3 u_plain_color;
uniform int u_has_floor;
uniform float u_floor_height;   // along u_up [m]
uniform float u_tile;           // side of a floor tile [m]
uniform int u_has_tank;
uniform vec3 u_tank_lower;      // [m]
uniform vec3 u_tank_upper;      // [m]
uniform vec3 u_floor_x;         // unit vectors along the floor
uniform vec3 u_floor_y;
uniform float u_pixel_angle;    // a pixel's width at a distance of 1 m, parallel: its width [m]

const vec3 HORIZON = vec3(0.74, 0.82, 0.88);
const vec3 ZENITH = vec3(0.17, 0.36, 0.62);
const vec3 FLOOR = vec3(0.56, 0.56, 0.55);
const vec3 SUN = vec3(1.0, 0.93, 0.80);

vec3 sky(vec3 direction) {
  if (u_plain == 1) return u_plain_color;
  float elevation = dot(direction, u_up);
  vec3 color = mix(HORIZON, ZENITH, 1.0 - exp(-2.2 * max(elevation, 0.0)));
  float glow = max(dot(direction, u_sun), 0.0);
  float glow8 = glow * glow * glow * glow * glow * glow * glow * glow;
  return color + SUN * (0.25 * glow8);
}

// The sun's disc, softened; seen in mirrors only.
vec3 sun_glint(vec3 direction) {
  float off = 1.0 - dot(direction, u_sun);
  return SUN * (9.0 * exp(-off * 900.0) + 0.6 * exp(-off * 60.0));
}

// Share of a line of half width w around x = 0 in [x - f, x + f], lines repeating with period 1.
float line_cover(float x, float w, float f) {
  float distance_to_line = abs(x - floor(x + 0.5));
  float cover = clamp((w + f - distance_to_line) / (2.0 * f), 0.0, 1.0) * min(w / f, 1.0);
  return mix(cover, 2.0 * w, smoothstep(0.15, 0.5, f));
}

// How much of the sky the tank's foot leaves to a point of the floor.
float contact_shadow(vec2 p) {
  vec3 middle = 0.5 * (u_tank_lower + u_tank_upper);
  vec3 half_size = 0.5 * (u_tank_upper - u_tank_lower);
  vec2 c = vec2(dot(middle, u_floor_x), dot(middle, u_floor_y));
  vec2 h = vec2(dot(half_size, abs(u_floor_x)), dot(half_size, abs(u_floor_y)));
  float reach = 0.35 * min(h.x, h.y) + 0.05 * max(h.x, h.y);
  vec2 outside = max(abs(p - c) - h, 0.0);
  float fade = 1.0 - clamp(length(outside) / reach, 0.0, 1.0);
  return 1.0 - 0.38 * fade * fade;
}

vec3 floor_color(vec3 point, float footprint) {
  vec2 p = vec2(dot(point, u_floor_x), dot(point, u_floor_y));
  vec2 tile = p / u_tile;
  float f = max(0.5 * footprint / u_tile, 1e-4);
  float lines = max(line_cover(tile.x, 0.012, f), line_cover(tile.y, 0.012, f));
  vec3 color = FLOOR * (1.0 - 0.22 * lines);
  return u_has_tank == 1 ? color * contact_shadow(p) : color;
}

// Color that comes against a direction (unit vector) to a point.
// @param travelled  length of the path from the eye to the point [m]
vec3 environment(vec3 point, vec3 direction, float travelled) {
  vec3 above = sky(direction);
  if (u_has_floor == 0) return above;
  float down = -dot(direction, u_up);
  float height = dot(point, u_up) - u_floor_height;
  if (down < 1e-4 || height < -1e-3 * u_tile) return above;
  float way = max(height, 0.0) / down;
  vec3 hit = point + way * direction;
  // A pixel's footprint on the floor, long where the floor is seen from the side.
  float footprint = u_pixel_angle * (u_size.z > 0.5 ? travelled + way : 1.0) / max(down, 0.05);
  vec3 color = floor_color(hit, footprint);
  vec3 horizon = u_plain == 1 ? u_plain_color : HORIZON;
  float far = 1.0 - exp(-(travelled + way) / (40.0 * u_tile));
  return mix(color, horizon, far * smoothstep(0.35, 0.0, down));
}
