// normal.frag: in: smoothed affine depth. Out: unit normal in eye space, towards the viewer; 0
// without fluid.
uniform sampler2D u_values;
uniform float u_range;  // a step of depth that is higher is between two surfaces [m]
layout(location = 0) out vec4 o_normal;

vec3 position(ivec2 pixel, out bool exists) {
  bool inside = all(greaterThanEqual(pixel, ivec2(0))) && all(lessThan(pixel, ivec2(u_size.xy)));
  float a = texelFetch(u_values, clamp(pixel, ivec2(0), ivec2(u_size.xy) - 1), 0).r;
  exists = inside && is_surface(a);
  return eye_position(vec2(pixel) + 0.5, depth_of(exists ? a : affine_depth(1.0)));
}

// Tangent along an axis from differences of positions to both sides, each weighted by 1/(dz^2 +
// pixel^2)^2. Both are tangent to a plane, so the normal of a plane is exact; on a gentle slope
// they count the same, which is the central difference; at a silhouette the smaller step wins.
// A strand or a groove of a single pixel faces the viewer: the smaller of its two steps is no slope
// of its own, and would be a speck that mirrors everything.
vec3 tangent(ivec2 pixel, ivec2 axis, vec3 p, float width) {
  bool has_next, has_previous;
  vec3 next = position(pixel + axis, has_next) - p;
  vec3 previous = p - position(pixel - axis, has_previous);
  float floor2 = width * width;
  float w_next = has_next ? 1.0 / (next.z * next.z + floor2) : 0.0;
  float w_previous = has_previous ? 1.0 / (previous.z * previous.z + floor2) : 0.0;
  bool lone = has_next == has_previous && next.z * previous.z <= 0.0 &&
              min(abs(next.z), abs(previous.z)) > u_range;
  if (lone || (!has_next && !has_previous)) return vec3(axis, 0.0);
  return w_next * w_next * next + w_previous * w_previous * previous;
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  bool exists;
  vec3 p = position(pixel, exists);
  o_normal = vec4(0.0);
  if (!exists) return;
  float width = 1.0 / pixels_per_meter(-p.z);  // of a pixel [m]
  vec3 x = normalize(tangent(pixel, ivec2(1, 0), p, width));
  vec3 y = normalize(tangent(pixel, ivec2(0, 1), p, width));
  o_normal = vec4(normalize(cross(x, y)), 0.0);
}
