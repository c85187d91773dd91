// environment.glsl: what stands behind and around the fluid, as a function of a ray: a sky with a
// sun, and a floor. World space, meters, linear colors multiplied by alpha. An analytic scene has
// an answer for every refracted and reflected ray, so nothing in front of the fluid can bleed in
// and there are no halos.
//
// BACKDROP and MIRRORED name the function of a direction, and of the spread of rays about it in
// pixels, that is seen behind the fluid, and in its surface.
uniform vec3 u_up;              // unit vector
uniform vec3 u_sun;             // unit vector towards the sun
uniform vec3 u_background_color;
uniform int u_has_floor;
uniform float u_floor_height;   // along u_up [m]
uniform float u_tile;           // side of a floor tile [m]
uniform int u_has_tank;
uniform vec3 u_tank_lower;      // [m]
uniform vec3 u_tank_upper;      // [m]
#ifdef SHADOW
uniform sampler2D u_shadow;     // share of the sun's light that the fluid lets through
uniform vec3 u_shadow_center;   // [m]
uniform vec3 u_shadow_x;        // axes of the shadow's picture [1/m]
uniform vec3 u_shadow_y;
uniform float u_shadow_strength;  // share of the sun in the floor's light
#endif
uniform vec3 u_eye;             // world space [m]
uniform vec3 u_floor_x;         // unit vectors along the floor
uniform vec3 u_floor_y;

const vec3 HORIZON = vec3(0.66, 0.73, 0.79);
const vec3 ZENITH = vec3(0.08, 0.20, 0.42);
const vec3 FLOOR = vec3(0.50, 0.50, 0.50);
const vec3 SUN = vec3(1.0, 0.93, 0.80);

#ifdef MAP
uniform sampler2D u_map;   // once around from -u_floor_y over -u_floor_x, below to above
uniform float u_map_width; // [texels]

// The map's mean over `spread` pixels of the picture.
vec4 mapped(vec3 direction, float spread) {
  float ahead = dot(direction, u_floor_y);
  float right = dot(direction, u_floor_x);
  float around = atan(right, ahead) / 6.2831853 + 0.5;
  float above = 1.0 - acos(clamp(dot(direction, u_up), -1.0, 1.0)) / 3.1415927;
  float texels = spread * u_map_width / (6.2831853 * pixels_per_radian());
  return vec4(textureLod(u_map, vec2(around, above), log2(max(texels, 1.0))).rgb, 1.0);
}
#endif

vec4 nothing(vec3 direction, float spread) { return vec4(0.0); }
vec4 plain(vec3 direction, float spread) { return vec4(u_background_color, 1.0); }

vec4 sky(vec3 direction, float spread) {
  float elevation = dot(direction, u_up);
  vec3 color = mix(HORIZON, ZENITH, 1.0 - exp(-2.2 * max(elevation, 0.0)));
  float glow = max(dot(direction, u_sun), 0.0);
  float glow8 = glow * glow * glow * glow * glow * glow * glow * glow;
  return vec4(color + SUN * (0.25 * glow8), 1.0);
}

// exp(-k off), a light about the sun of variance 1/k, seen by rays of a variance of their own: the
// light is wider by that, and as much less bright as it is larger.
float lobe(float k, float off, float variance) {
  float sharpness = 1.0 / (1.0 + k * variance);
  return sharpness * exp(-off * k * sharpness);
}

// Lights that only mirrors show: the sun's disc, softened, and a bright band of sky all around,
// which draws waves as a studio's soft boxes draw glass.
vec4 sky_with_lights(vec3 direction, float spread) {
  float wide = spread / pixels_per_radian();
  float variance = wide * wide / 12.0;  // of a pixel's square, along each side
  float off = 1.0 - dot(direction, u_sun);
  float elevation = dot(direction, u_up);
  float band = smoothstep(0.02, 0.45, elevation) * (1.0 - 0.6 * smoothstep(0.5, 0.9, elevation));
  vec3 sun = SUN * (60.0 * lobe(700.0, off, variance) + 5.0 * lobe(40.0, off, variance));
  return sky(direction, spread) + vec4(sun + vec3(1.1, 1.25, 1.4) * 1.6 * band, 0.0);
}

// Share of lines of half width w, repeating with period 1, in [x - f, x + f].
float line_cover(float x, float w, float f) {
  float off = abs(x - floor(x + 0.5));
  float cover = clamp(min(w + f - off, 2.0 * min(w, f)), 0.0, 1.0) / (2.0 * f);
  return mix(cover, 2.0 * w, smoothstep(0.1, 0.5, f));
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

// Light of sun and sky that reaches a point of the floor through the fluid.
vec3 sunlight(vec3 point) {
#ifdef SHADOW
  vec3 p = point - u_shadow_center;
  vec2 at = vec2(dot(u_shadow_x, p), dot(u_shadow_y, p)) + 0.5;
  return 1.0 - u_shadow_strength * (1.0 - textureLod(u_shadow, at, 0.0).rgb);
#else
  return vec3(1.0);
#endif
}

// @param reach  half of a pixel's extent on the floor along u_floor_x and u_floor_y [m]
vec3 floor_color(vec3 point, vec2 reach) {
  vec2 p = vec2(dot(point, u_floor_x), dot(point, u_floor_y));
  vec2 f = max(reach / u_tile, 1e-3);
  float lines = max(line_cover(p.x / u_tile, 0.010, f.x), line_cover(p.y / u_tile, 0.010, f.y));
  vec3 color = FLOOR * (1.0 - 0.35 * lines) * sunlight(point);
  return u_has_tank == 1 ? color * contact_shadow(p) : color;
}

float height_above_floor(vec3 point) { return dot(point, u_up) - u_floor_height; }
bool is_below_floor(vec3 point) {
  return u_has_floor == 1 && height_above_floor(point) < 0.0 && height_above_floor(u_eye) > 0.0;
}
float distance_to_floor(vec3 point, vec3 direction) {
  float down = -dot(direction, u_up);
  return u_has_floor == 1 && down > 1e-4 ? max(height_above_floor(point), 0.0) / down : NOWHERE;
}

// Light that comes against a direction (unit vector) to a point.
// @param beyond     that from farther than the floor
// @param travelled  length of the path from the eye to the point [m]
// @param spread     how much wider than a pixel the bundle of rays is, behind a curved surface
vec4 environment(vec4 beyond, vec3 point, vec3 direction, float travelled, float spread) {
  float way = distance_to_floor(point, direction);
  if (!is_met(way) || height_above_floor(u_eye) < 0.0) return beyond;
  float down = -dot(direction, u_up);
  // A pixel on the floor: long along the ray where it comes in flat.
  float wide = 0.7 * spread / pixels_per_meter(travelled + way);
  vec2 flat_direction = vec2(dot(direction, u_floor_x), dot(direction, u_floor_y));
  flat_direction = abs(flat_direction) / max(length(flat_direction), 1e-6);
  vec2 reach = wide * (flat_direction / max(down, 0.01) + flat_direction.yx);
  vec3 color = floor_color(point + way * direction, reach);
  float far = 1.0 - exp(-(travelled + way) / (30.0 * u_tile));
  return mix(vec4(color, 1.0), beyond, far * smoothstep(0.45, 0.0, down));
}

vec3 to_world(vec3 v) { return transpose(mat3(u_view)) * v; }

// What a viewing ray (eye space) meets if there is no fluid.
vec4 seen(vec3 origin, vec3 direction) {
  vec3 d = to_world(direction);
  return environment(BACKDROP(d, 1.0), u_eye + to_world(origin), d, 0.0, 1.0);
}
