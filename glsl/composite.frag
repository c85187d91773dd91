// composite.frag: in: smoothed affine depth of front and back, smoothed thickness [m], normal (eye
// space). Out: the fluid, linear, multiplied by alpha, to be blended over what is behind.
uniform sampler2D u_normal;
uniform vec3 u_absorption;         // [1/m]
uniform vec3 u_scatter;            // color of deep fluid
uniform float u_sprite_thickness;  // mean thickness of a single sprite [m]
uniform sampler2D u_spheres;       // affine depth with crowding
uniform sampler2D u_tint;          // weight times color and weight (tint.frag)
uniform int u_has_tint;            // 1: the fluid has its particles' colors
layout(location = 0) out vec4 o_color;

const float SPREAD = 3.0;  // of rays from a body's surface, in that of a pixel

// Beer-Lambert: what is left of light after a way through the fluid.
vec3 transmittance(float way) { return exp(-u_absorption * way); }

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

// The surface that a drop hides: the mean of four normals around the drop, 0 where no fluid is
// farther away. The less of them there are, the less is known of what the drop hides.
vec3 normal_behind(ivec2 pixel, float depth) {
  vec3 sum = vec3(0.0);
  int away = int(2.5 * u_drop_radius * pixels_per_meter(depth)) + 2;
  for (int k = 0; k < 4; ++k) {
    int side = (k & 1) == 0 ? away : -away;
    ivec2 at = pixel + (k < 2 ? ivec2(side, 0) : ivec2(0, side));
    at = clamp(at, ivec2(0), ivec2(u_size.xy) - 1);
    float a = texelFetch(u_depth, at, 0).r;
    bool farther = is_surface(a) && depth_of(a) > depth + 2.0 * u_drop_radius;
    sum += farther ? texelFetch(u_normal, at, 0).xyz : vec3(0.0);
  }
  return 0.25 * sum;
}

// What the surface behind a drop adds to the drop: as far as the drop lets light through it
// mirrors, and below it the ray goes on more steeply.
struct Behind {
  vec3 mirrored;   // share of its light that the surface mirrors
  vec3 direction;  // where that comes from
  float way;       // through the fluid behind, over that straight on
  float meets;     // how far what the drop mirrors is that surface, and not what is beyond
};

Behind behind_drop(vec3 view, vec3 n, vec3 hidden, float body) {
  float known2 = dot(hidden, hidden);
  float share = (1.0 - body) * known2;
  vec3 normal = hidden / sqrt(max(known2, 1e-12));
  float c = clamp(-dot(view, normal), 0.0, 1.0);
  float bent = sqrt(1.0 - (1.0 - c * c) / (u_refractive_index * u_refractive_index));
  return Behind(share * fresnel(c, u_refractive_index) * transmittance(chord_of_drop(view, n)),
                reflect(view, normal), mix(1.0, c / max(bent, 1e-6), share),
                body < 1.0 ? known2 * smoothstep(0.0, 0.3, -dot(reflect(view, n), normal)) : 0.0);
}

// How far rays that are a pixel apart are from one another [pixels] where the surface has mirrored
// them: twice as far as its normals turn from pixel to pixel. Across an edge the side that turns
// less is the surface's own.
float mirrored_spread(ivec2 pixel) {
  ivec2 last = ivec2(u_size.xy) - 1;
  vec3 n = texelFetch(u_normal, pixel, 0).xyz;
  float turn2 = 0.0;
  for (int k = 0; k < 2; ++k) {
    ivec2 axis = k == 0 ? ivec2(1, 0) : ivec2(0, 1);
    vec3 next = texelFetch(u_normal, min(pixel + axis, last), 0).xyz - n;
    vec3 previous = texelFetch(u_normal, max(pixel - axis, 0), 0).xyz - n;
    turn2 += min(dot(next, next), dot(previous, previous));
  }
  return 2.0 * sqrt(0.5 * turn2) * pixels_per_radian();
}

// @param to_mesh  length of the straight way to a mesh [m]
// @param body     0 for a drop, 1 in a body of fluid
// @param hidden   normal of the surface that a drop hides
Shade fluid(vec3 p, vec3 view, vec3 n, float thickness, float to_mesh, float body, vec3 hidden) {
  vec3 position = u_eye + to_world(p);
  n = upright_at_floor(n, position);
  float mirrored = fresnel(clamp(-dot(view, n), 0.0, 1.0), u_refractive_index);
  // Colors that mean something are not to drown in the sky's reflection.
  mirrored *= u_has_tint == 1 ? 0.3 : 1.0;
  vec3 mirror = to_world(reflect(view, n));
  // A drop turns rays that are a pixel apart by a pixel's share of its radius.
  float of_drop = pixels_per_radian() / (u_drop_radius * pixels_per_meter(-p.z));
  float spread = mix(max(of_drop, SPREAD), SPREAD, body);
  float wide = max(spread, mirrored_spread(ivec2(gl_FragCoord.xy)));
  vec3 reflection = environment(MIRRORED(mirror, wide), position, mirror, -p.z, wide).rgb;
  Ray ray = refracted(p, view, n, thickness, body);
  vec4 behind = environment(BACKDROP(ray.direction, spread), ray.at, ray.direction, -p.z, spread);
#ifdef MESHES
  vec3 light;
  float way;
  float farthest = 1.3 * max(ray.way, is_met(to_mesh) ? to_mesh : 0.0);
  if (meets_mesh(p, mat3(u_view) * ray.first, farthest, way, light)) {
    behind = vec4(light, 1.0);
    ray.way = min(ray.way, way);
  }
#endif
  Behind also = behind_drop(view, n, hidden, body);
  float own = min(chord_of_drop(view, n), ray.way);
  ray.way = own + (ray.way - own) * also.way;
  vec3 left = transmittance(ray.way);
  vec3 up_facing = to_world(n);
  float lit = 0.60 + 0.25 * dot(up_facing, u_up) + 0.35 * dot(up_facing, u_sun);
  vec3 through = behind.rgb * left + body_color() * lit * (1.0 - left);
  through = mix(through, MIRRORED(to_world(also.direction), SPREAD).rgb, also.mirrored);
  // At its rim a drop mirrors what it hides: the same as is seen through it.
  mirrored *= 1.0 - also.meets;
  vec3 clear = (1.0 - mirrored) * (1.0 - also.mirrored) * (1.0 - behind.a) * left;
  return Shade(mix(through, reflection, mirrored), clear);
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
  vec3 n = texelFetch(u_normal, pixel, 0).xyz;
  // What is crowded by two thirds is a body's edge, whatever rounding makes of it.
  float body = min(1.6 * crowding_of(texelFetch(u_spheres, pixel, 0).r), 1.0);
  share *= cut_at_walls(p, view, (p.z - back_at(pixel, -p.z).z) / -view.z, body, n);
  // The floor hides what sticks out below it.
  if (is_below_floor(u_eye + to_world(p))) share = 0.0;
  float thickness = texelFetch(u_thickness, pixel, 0).r;
  // Where a lone sprite thins out there is less than a particle: fading it takes the beads off the
  // outline.
  share *= smoothstep(0.1, 0.8, thickness / u_sprite_thickness);
  float to_mesh = NOWHERE;
#ifdef MESHES
  // Meshes hide the fluid behind them.
  float mesh = texelFetch(u_mesh_depth, pixel, 0).r;
  if (mesh > a) share = 0.0;
  if (is_surface(mesh)) to_mesh = max((depth_of(mesh) + p.z) / -view.z, 0.0);
#endif
  Shade shade = fluid(p, view, n, thickness, to_mesh, body, normal_behind(pixel, -p.z));
  // One alpha for three channels: that of the clearest would let the colors of others through, so
  // the least clear one has it, and the rest is what background_color adds to the others.
  float clear = min(shade.clear.r, min(shade.clear.g, shade.clear.b));
  vec3 light = shade.light + (shade.clear - clear) * u_background_color;
  o_color = share > 0.0 ? share * display(light, 1.0 - clear) : vec4(0.0);
}
