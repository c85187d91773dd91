// composite.frag: in: smoothed affine depth, smoothed thickness [m], normal (eye space). Out: the
// fluid, linear, multiplied by alpha, to be blended over what is behind.
uniform sampler2D u_depth;
uniform sampler2D u_thickness;
uniform sampler2D u_normal;
uniform vec3 u_absorption;         // [1/m]
uniform vec3 u_scatter;            // color of deep fluid
uniform float u_refractive_index;
uniform float u_radius;            // of a sprite [m]
uniform float u_sprite_thickness;  // mean thickness of a single sprite [m]
uniform sampler2D u_tint;          // weight times color and weight (tint.frag)
uniform int u_has_tint;            // 1: the fluid has its particles' colors
layout(location = 0) out vec4 o_color;

const float SPREAD = 3.0;    // of rays from a curved surface, in that of a pixel
const float MOST_WAY = 1e3;  // of a ray in the fluid [m]

// Share of unpolarized light that a smooth dielectric mirrors (Fresnel); c is the cosine of
// incidence.
float fresnel(float c, float index) {
  float g2 = index * index - 1.0 + c * c;
  float g = sqrt(max(g2, 0.0));
  float a = (g - c) / (g + c);
  float b = (c * (g + c) - 1.0) / (c * (g - c) + 1.0);
  return 0.5 * a * a * (1.0 + b * b);
}

// Beer-Lambert: what is left of light after a way through the fluid.
vec3 transmittance(float way) { return exp(-u_absorption * way); }

// Fluid that stands on the floor does not curl in below it, as its lowest spheres do.
vec3 upright_at_floor(vec3 n, vec3 position) {
  vec3 up = mat3(u_view) * u_up;
  float height = u_has_floor == 1 ? height_above_floor(position) / u_radius : 1e9;
  float nearness = 1.0 - smoothstep(1.0, 3.0, height);
  return normalize(n - nearness * min(dot(n, up), 0.0) * up);
}

// How far it is to the tank's wall from inside: 1e9 if there is none. Floor and surface are none.
float distance_to_wall(vec3 point, vec3 direction, out vec3 outward) {
  vec3 side = mix(vec3(-1.0), vec3(1.0), step(0.0, direction));
  vec3 face = mix(u_tank_lower, u_tank_upper, step(0.0, direction));
  vec3 way = (face - clamp(point, u_tank_lower, u_tank_upper)) / (side * max(abs(direction), 1e-6));
  way += 1e9 * step(0.9, abs(u_up));
  float nearest = min(way.x, min(way.y, way.z));
  outward = side * vec3(lessThanEqual(way, vec3(nearest)));
  return u_has_tank == 1 ? nearest : 1e9;
}

// A ray of light, followed backwards.
struct Ray {
  vec3 at;         // world space [m]
  vec3 direction;  // unit vector
  float way;       // length in the fluid so far [m]
};

// On through the fluid to the floor, or out through a wall of the tank; a wall that it meets too
// flat mirrors it.
void follow_to_wall_or_floor(inout Ray ray) {
  bool inside = true;
  for (int k = 0; k < 2; ++k) {
    vec3 outward;
    float to_floor = distance_to_floor(ray.at, ray.direction);
    float to_wall = distance_to_wall(ray.at, ray.direction, outward);
    float way = inside ? min(min(to_floor, to_wall), MOST_WAY) : 0.0;
    ray.at += way * ray.direction;
    ray.way += way;
    vec3 bent = refract(ray.direction, -outward, u_refractive_index);
    bool mirrors = dot(bent, bent) < 0.5;
    inside = inside && to_wall < to_floor;
    if (inside) ray.direction = mirrors ? reflect(ray.direction, outward) : bent;
    inside = inside && mirrors;
  }
}

// The ray from a point of the surface to what is seen through the fluid.
Ray refracted(vec3 position, vec3 view, vec3 n, float thickness) {
  float eta = 1.0 / u_refractive_index;
  Ray bound = Ray(position, to_world(refract(view, n, eta)), 0.0);
  follow_to_wall_or_floor(bound);
  // Or out at a free surface: a drop's far side bends the ray once more by as much.
  Ray free = Ray(position, to_world(refract(view, n, eta * eta)), thickness);
  // Which of them, tells how much of the straight way to wall or floor is fluid.
  vec3 straight = to_world(view);
  vec3 outward;
  float to_end = min(distance_to_floor(position, straight),
                     distance_to_wall(position, straight, outward));
  float is_bound = smoothstep(0.6, 0.9, thickness / max(to_end, 1e-3 * u_tile));
  return Ray(mix(free.at, bound.at, is_bound),
             normalize(mix(free.direction, bound.direction, is_bound)),
             mix(free.way, bound.way, is_bound));
}

// Color of the fluid itself: its own, or by its particles' values. Sums are interpolated, not
// colors: texels without fluid have no weight.
vec3 body_color() {
  if (u_has_tint == 0) return u_scatter;
  vec2 at = gl_FragCoord.xy * vec2(textureSize(u_tint, 0)) / u_size.xy - 0.5;
  ivec2 last = textureSize(u_tint, 0) - 1;
  ivec2 low = max(ivec2(floor(at)), 0);
  ivec2 high = min(low + 1, last);
  vec2 share = clamp(at - vec2(low), 0.0, 1.0);
  vec4 left = mix(texelFetch(u_tint, low, 0), texelFetch(u_tint, ivec2(low.x, high.y), 0), share.y);
  vec4 right = mix(texelFetch(u_tint, ivec2(high.x, low.y), 0),
                   texelFetch(u_tint, high, 0), share.y);
  vec4 sums = mix(left, right, share.x);
  return sums.rgb / max(sums.a, 1e-20);
}

// Light from the surface, and how much of that of a transparent background comes through.
struct Shade {
  vec3 light;
  vec3 clear;
};

Shade fluid(vec3 p, vec3 view, vec3 n, float thickness) {
  vec3 position = u_eye + to_world(p);
  n = upright_at_floor(n, position);
  float mirrored = fresnel(clamp(-dot(view, n), 0.0, 1.0), u_refractive_index);
  // Colors that mean something are not to drown in the sky's reflection.
  mirrored *= u_has_tint == 1 ? 0.3 : 1.0;
  vec3 mirror = to_world(reflect(view, n));
  vec3 reflection = environment(MIRRORED(mirror), position, mirror, -p.z, SPREAD).rgb;
  Ray ray = refracted(position, view, n, thickness);
  vec4 behind = environment(BACKDROP(ray.direction), ray.at, ray.direction, -p.z, SPREAD);
  vec3 left = transmittance(ray.way);
  vec3 up_facing = to_world(n);
  float lit = 0.60 + 0.25 * dot(up_facing, u_up) + 0.35 * dot(up_facing, u_sun);
  vec3 through = behind.rgb * left + body_color() * lit * (1.0 - left);
  return Shade(mix(through, reflection, mirrored), (1.0 - mirrored) * (1.0 - behind.a) * left);
}

// Share of the 3x3 pixels around that hold fluid: softens the outline.
float coverage(ivec2 pixel) {
  float sum = 0.0;
  ivec2 last = ivec2(u_size.xy) - 1;
  for (int y = -1; y <= 1; ++y) {
    for (int x = -1; x <= 1; ++x) {
      float weight = float((2 - abs(x)) * (2 - abs(y)));
      ivec2 at = clamp(pixel + ivec2(x, y), ivec2(0), last);
      sum += is_surface(texelFetch(u_depth, at, 0).r) ? weight : 0.0;
    }
  }
  return sum / 16.0;
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec3 view = normalize(ray_direction(gl_FragCoord.xy));
  float a = texelFetch(u_depth, pixel, 0).r;
  float share = is_surface(a) ? clamp(1.8 * coverage(pixel) - 0.55, 0.0, 1.0) : 0.0;
  vec3 p = eye_position(gl_FragCoord.xy, is_surface(a) ? depth_of(a) : 1.0);
  // The floor hides what sticks out below it.
  if (is_below_floor(u_eye + to_world(p))) share = 0.0;
  vec3 n = texelFetch(u_normal, pixel, 0).xyz;
  float thickness = texelFetch(u_thickness, pixel, 0).r;
  // Where a lone sprite thins out there is less than a particle: fading it takes the beads off the
  // outline.
  share *= smoothstep(0.1, 0.8, thickness / u_sprite_thickness);
  Shade shade = fluid(p, view, n, thickness);
  // One alpha for three channels: that of the clearest would let the colors of others through, so
  // the least clear one has it, and the rest is what background_color adds to the others.
  float clear = min(shade.clear.r, min(shade.clear.g, shade.clear.b));
  vec3 light = shade.light + (shade.clear - clear) * u_background_color;
  o_color = share > 0.0 ? share * display(light, 1.0 - clear) : vec4(0.0);
}
