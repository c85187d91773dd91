// thickness_smooth.frag: in: thickness [m] and affine depth. Out: thickness [m], smoothed along one
// axis. Pixels without fluid carry no weight.
uniform sampler2D u_depth;
uniform float u_radius;  // [m]
uniform float u_range;   // [m]
layout(location = 0) out float o_thickness;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  float a = texelFetch(u_depth, pixel, 0).r;
  float thickness = texelFetch(u_values, pixel, 0).r;
  o_thickness = thickness;
  if (!is_surface(a) || thickness <= 0.0) return;
  float radius = u_radius * pixels_per_meter(depth_of(a));
  o_thickness = max(smoothed(pixel, thickness, radius, vec2(1.0 / u_range)), 0.0);
}
