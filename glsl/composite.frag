// composite.frag: in: smoothed affine depth, smoothed thickness [m], normal (eye space). Out: the picture,
// sRGB-encoded, opaque.
uniform sampler2D u_depth;
uniform sampler2D u_thickness;
uniform sampler2D u_normal;
uniform vec3 u_absorption;         // [1/m]
uniform vec3 u_scatter;            // color of deep fluid
uniform float u_refractive_index;
uniform vec3 u_eye;                // world space [m]
uniform float u_exposure;
layout(location = 0) out vec4 o_color;

// Share of unpolarized light that a smooth dielectric mirrors (Fresnel); c is the cosine of incidence.
float fresnel(float c, float index) {
  float g2 = index * index - 1.0 + c * c;
  float g = sqrt(max(g2, 0.0));
  float a = (g - c) / (g + c);
  float b = (c * (g + c) - 1.0) / (c * (g - c) + 1.0);
  return 0.5 * a * a * (1.0 + b * b);
}

vec3 to_world(vec3 v) { return transpose(mat3(u_view)) * v; }

// Beer-Lambert: what is left of light after a way through the fluid.
vec3 transmittance(float way) { return exp(-u_absorption * way); }

vec3 fluid_color(vec3 p, vec3 view, vec3 n, float thickness) {
  vec3 position = u_eye + to_world(p);
  float cosine = clamp(-dot(view, n), 0.0, 1.0);
  float mirrored = fresnel(cosine, u_refractive_index);
  vec3 up_mirror = to_world(reflect(view, n));
  vec3 reflection = environment(position, up_mirror, -p.z) + (u_plain == 1 ? vec3(0.0) : sun_glint(up_mirror));
  // Through: bent at the surface, then straight on through the fluid and out behind it, or to the floor.
  vec3 inward = to_world(refract(view, n, 1.0 / u_refractive_index));
  vec3 left = transmittance(thickness);
  vec3 behind = environment(position, inward, -p.z);
  vec3 through = behind * left + u_scatter * (1.0 - left);
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

// Values below 0.8 stay what they are; brighter ones approach 1.
vec3 tone(vec3 c) {
  vec3 over = max(c - 0.8, 0.0);
  return min(c, 0.8) + 0.2 * over / (over + 0.2);
}

vec3 srgb(vec3 c) {
  return mix(12.92 * c, 1.055 * pow(max(c, 1e-5), vec3(1.0 / 2.4)) - 0.055, greaterThan(c, vec3(0.0031308)));
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec3 origin = ray_origin(gl_FragCoord.xy);
  vec3 view = normalize(ray_direction(gl_FragCoord.xy));
  float a = texelFetch(u_depth, pixel, 0).r;
  float share = is_surface(a) ? clamp(1.8 * coverage(pixel) - 0.55, 0.0, 1.0) : 0.0;
  vec3 color = vec3(0.0);
  if (share < 1.0) color = environment(u_eye + to_world(origin), to_world(view), 0.0);
  if (share > 0.0) {
    vec3 p = eye_position(gl_FragCoord.xy, depth_of(a));
    vec3 n = texelFetch(u_normal, pixel, 0).xyz;
    float thickness = texelFetch(u_thickness, pixel, 0).r;
    color = mix(color, fluid_color(p, view, n, thickness), share);
  }
  o_color = vec4(srgb(tone(color * u_exposure)), 1.0);
}
