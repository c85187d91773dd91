// frame.glsl: the camera, and the ways between pixel, eye space and the depth that the passes
// store.
//
// Eye space: x right, y up, z out of the picture, meters. Depth d is -z, measured along the viewing
// axis. Stored is the *affine depth* a: 1/d in perspective, -d in parallel projection. On a plane
// it is an affine function of the pixel's coordinates in both, so that a filter that keeps straight
// lines straight keeps planes exactly; and nearer is always larger, so that blending with MAX finds
// the front.
layout(std140) uniform Frame {
  mat4 u_view;  // world to eye space
  // Half width and half height of what is seen (at depth 1 in perspective), near, far [m].
  vec4 u_lens;
  // Width, height [pixels]; 1 perspective, 0 parallel; pixels per meter (perspective: at depth 1).
  vec4 u_size;
};

// Affine depth where there is no fluid; of far sides, whose least is looked for, its opposite.
const float NOTHING = -1e30;
const float LEAST_SURFACE = -1e29;  // less than that of any surface
// How far it is to what a ray does not meet [m].
const float NOWHERE = 1e30;

bool is_surface(float a) { return abs(a) < -LEAST_SURFACE; }
bool is_met(float way) { return way < 1e29; }
float affine_depth(float d) { return u_size.z > 0.5 ? 1.0 / d : -d; }
float depth_of(float a) { return u_size.z > 0.5 ? 1.0 / a : -a; }

// How much affine depth is less a length [m] farther away, and more a length nearer, at most at
// half of the depth.
float farther(float a, float length) {
  return u_size.z > 0.5 ? a * a * length / (1.0 + a * length) : length;
}
float nearer(float a, float length) {
  float share = min(a * length, 0.5);
  return u_size.z > 0.5 ? a * share / (1.0 - share) : length;
}

// The depth of spheres carries the crowding of the particle that is in front in its two lowest
// bits: 0 in a body of fluid, 3 for a drop alone. They change the depth by at most 4e-7 of itself,
// and the blending that finds the front finds them as well.
float with_crowding(float a, float crowding) {
  uint level = uint(3.5 - 3.0 * crowding);
  return uintBitsToFloat((floatBitsToUint(a) & ~3u) | level);
}
// The same of a smoothed depth, by the sphere that was in front.
float with_crowding_of(float a, float sphere) {
  return uintBitsToFloat((floatBitsToUint(a) & ~3u) | (floatBitsToUint(sphere) & 3u));
}
float crowding_of(float a) { return 1.0 - float(floatBitsToUint(a) & 3u) / 3.0; }
// A drop alone, 3 in those bits.
bool is_alone(float crowding) { return 3.5 - 3.0 * crowding >= 3.0; }

// Of less than half of a body's crowding. Two thirds are a body's edge, or a sheet.
const uint DROP = 2u;
bool is_body(float a) { return (floatBitsToUint(a) & DROP) == 0u; }

// How far depth is smoothed there, over a body. A drop is round already; where a few particles have
// met, a kernel as wide as their sprites would leave a flat disc of each, and a ninth joins them.
float smoothing_share(float a) { return crowding_of(a) * crowding_of(a); }

// The viewing ray of a point of the picture [pixels]: origin + d * direction, d the depth.
vec3 ray_origin(vec2 pixel) {
  vec2 p = (2.0 * pixel / u_size.xy - 1.0) * u_lens.xy;
  return vec3((1.0 - u_size.z) * p, 0.0);
}
vec3 ray_direction(vec2 pixel) {
  vec2 p = (2.0 * pixel / u_size.xy - 1.0) * u_lens.xy;
  return vec3(u_size.z * p, -1.0);
}
vec3 eye_position(vec2 pixel, float d) { return ray_origin(pixel) + d * ray_direction(pixel); }

// The point of the picture [pixels] where a point in eye space is seen.
vec2 pixel_of(vec3 p) {
  vec2 slope = u_size.z > 0.5 ? p.xy / -p.z : p.xy;
  return (slope / u_lens.xy * 0.5 + 0.5) * u_size.xy;
}

// Pixels that a length of one meter covers at a depth.
float pixels_per_meter(float d) { return u_size.z > 0.5 ? u_size.w / d : u_size.w; }

// Pixels that rays one radian apart are from one another. Parallel rays: as if the picture were
// seen from as far away as it is high.
float pixels_per_radian() { return u_size.z > 0.5 ? u_size.w : u_size.y; }
