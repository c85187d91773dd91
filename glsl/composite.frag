// composite.frag: in: smoothed affine depth, smoothed thickness [m], normal (eye space). Out: the
// picture, sRGB-encoded, opaque.
uniform sampler2D u_depth;
uniform sampler2D u_thickness;
uniform sampler2D u_normal;
uniform vec3 u_absorption;         // [1/m]
uniform vec3 u_scatter;            // color of deep fluid
uniform float u_refractive_index;
uniform float u_radius;            // of a sprite [m]
uniform float u_sprite_thickness;  // mean thickness of a single sprite [m]
layout(location = 0) out vec4 o_color;

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

vec3 fluid_color(vec3 p, vec3 view, vec3 n, float thickness) {
  vec3 position = u_eye + to_world(p);
  n = upright_at_floor(n, position);
  float cosine = clamp(-dot(view, n), 0.0, 1.0);
  float mirrored = fresnel(cosine, u_refractive_index);
  vec3 mirror = to_world(reflect(view, n));
  vec3 reflection = environment(position, mirror, -p.z, 3.0) + lights(mirror);
  // Through: bent at the surface, and on to the floor; or out behind the fluid, where a drop's far
  // side bends the ray once more by as much.
  float eta = 1.0 / u_refractive_index;
  vec3 once = to_world(refract(view, n, eta));
  vec3 twice = to_world(refract(view, n, eta * eta));
  float to_floor = distance_to_floor(position, once);
  float beyond = smoothstep(2.0, 6.0, to_floor / max(thickness, 1e-4 * u_tile));
  vec3 behind = environment(position, normalize(mix(once, twice, beyond)), -p.z, 3.0);
  vec3 left = transmittance(thickness);
  vec3 up_facing = to_world(n);
  float lit = 0.60 + 0.25 * dot(up_facing, u_up) + 0.35 * dot(up_facing, u_sun);
  vec3 through = behind * left + u_scatter * lit * (1.0 - left);
  return mix(through, reflection, mirrored);
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
  vec3 color = seen(ray_origin(gl_FragCoord.xy), view);
  o_color = display(share > 0.0 ? mix(color, fluid_color(p, view, n, thickness), share) : color);
}
