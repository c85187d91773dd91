// depth_smooth.frag: in: affine depth, and that of the spheres for their crowding. Out: affine
// depth, smoothed along one axis. A drop is round already: the kernel shrinks with the crowding.
uniform sampler2D u_spheres;
uniform float u_radius;  // in a body of fluid [m]
uniform float u_range;   // [m]
layout(location = 0) out float o_depth;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  float a = texelFetch(u_values, pixel, 0).r;
  o_depth = a;
  if (!is_surface(a)) return;
  float radius = u_radius * crowding_of(texelFetch(u_spheres, pixel, 0).r);
  if (radius <= 0.0) return;
  float d = depth_of(a);
  // The window of depths d ± range in affine depth; nothing is nearer than half of d.
  float farther = a - affine_depth(d + u_range);
  float nearer = affine_depth(u_size.z > 0.5 ? max(d - u_range, 0.5 * d) : d - u_range) - a;
  o_depth = smoothed(pixel, a, radius * pixels_per_meter(d), 1.0 / vec2(farther, nearer));
}
