// sphere_shading.frag: in: affine depth, normal (eye space) and color of spheres. Out: the
// spheres, linear, opaque, to be blended over what is behind. White light and no highlights: the
// colors mean something.
uniform sampler2D u_depth;
uniform sampler2D u_normal;
#ifdef MESHES
uniform sampler2D u_mesh_depth;  // affine
#endif
uniform float u_radius;  // of a sphere [m]
layout(location = 0) out vec4 o_color;

const float SUN_SHARE = 0.60;
const float SKY_SHARE = 0.40;     // facing up
const float GROUND_SHARE = 0.22;  // facing down
const int TAPS = 16;
const float REACH = 5.0;     // of occlusion, in radii
const float STRENGTH = 5.0;  // of occlusion

// Share of the sky that spheres nearby leave to a point: of random directions in the tangent's half
// space, sampled as points of the picture in a disk around the pixel ([MOBH11]).
float openness(ivec2 pixel, vec3 p, vec3 n) {
  float reach = REACH * u_radius;
  float disk = min(reach * pixels_per_meter(-p.z), 0.25 * u_size.y);
  // A turn of the spiral per pixel of a 4x4 square hides that every pixel has the same few taps.
  ivec2 cell = pixel & 3;
  float place = float(cell.x * 5 + cell.y * 3) / 16.0 + 0.31 * float(cell.x ^ cell.y);
  float turn = 6.2831853 * fract(place);
  float sum = 0.0;
  for (int k = 0; k < TAPS; ++k) {
    float share = (float(k) + 0.5) / float(TAPS);
    float angle = turn + 2.3999632 * float(k);
    ivec2 at = pixel + ivec2(disk * sqrt(share) * vec2(cos(angle), sin(angle)));
    at = clamp(at, ivec2(0), ivec2(u_size.xy) - 1);
    float a = texelFetch(u_depth, at, 0).r;
    vec3 v = eye_position(vec2(at) + 0.5, depth_of(is_surface(a) ? a : affine_depth(1.0))) - p;
    float d2 = dot(v, v);
    float fade = is_surface(a) ? max(1.0 - d2 / (reach * reach), 0.0) : 0.0;
    sum += fade * max(dot(v, n) - 0.05 * u_radius, 0.0) / (d2 + 0.01 * u_radius * u_radius);
  }
  return clamp(1.0 - STRENGTH * u_radius * sum / float(TAPS), 0.0, 1.0);
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  float a = texelFetch(u_depth, pixel, 0).r;
  o_color = vec4(0.0);
  vec3 p = eye_position(gl_FragCoord.xy, is_surface(a) ? depth_of(a) : 1.0);
  if (is_surface(a) && !is_below_floor(u_eye + to_world(p))) {
    vec4 surface = texelFetch(u_normal, pixel, 0);
    vec3 n = to_world(surface.xyz);
    float sun = SUN_SHARE * max(dot(n, u_sun), 0.0);
    float sky = mix(GROUND_SHARE, SKY_SHARE, 0.5 + 0.5 * dot(n, u_up));
    float open = openness(pixel, p, surface.xyz);
    vec3 light = linear_color(surface.w) * (sun * mix(0.5, 1.0, open) + sky * open);
    o_color = display(light, 1.0);
#ifdef MESHES
    if (texelFetch(u_mesh_depth, pixel, 0).r > a) o_color = vec4(0.0);
#endif
  }
}
