// curvature_flow.frag: one stage of a time step in which the surface moves along its normal by its
// mean curvature [vdL09]. In: affine depth after the last two stages, and that of the spheres with
// their crowding. Out: affine depth.
//
// The surface is the level set d a(X/d, Y/d) = 1 in perspective and a(X, Y) + d = 0 in parallel
// projection. Its motion by curvature, seen along the ray, is in both
//
//   da/dt = D s^2 (M11 a_xx + 2 M12 a_xy + M22 a_yy),   M = I + r r^T - t t^T,   t = n_xy - n_z r,
//
// with s the pixels in a meter at this depth, n the unit normal (a_x, a_y, a - r . (a_x, a_y))
// and r the slopes of the ray, all in that space; parallel: r = 0 and n = (a_x, a_y, 1). The
// second differences of a plane vanish in affine depth, so a plane rests, and neither camera nor
// resolution is in the motion. On flat surfaces it is diffusion: after the time T a bump has been
// smoothed by a Gaussian of variance 2 D T.
//
// Explicit steps are stable only up to D T s^2 tr M = 1/2, and a smoothing length is many pixels.
// A step has therefore several stages, Runge-Kutta-Legendre's of first order [MBA14], which reach
// (n^2 + n) / 2 times as far in n stages, and no stage overshoots:
//
//   Y_j = (2j - 1)/j (Y_(j-1) + 2 / (n^2 + n) T F(Y_(j-1))) - (j - 1)/j Y_(j-2)
//
// raster/curvature_flow_lanes.cpp is this file in C++.
uniform sampler2D u_values;    // Y_(j-1)
uniform sampler2D u_previous;  // Y_(j-2)
uniform sampler2D u_spheres;
uniform float u_j;         // number of the stage
uniform float u_stages;    // n
uniform float u_variance;  // D T of the step in a body of fluid [m^2]
uniform float u_range;     // neighbors that are farther away in depth belong to another surface [m]
layout(location = 0) out float o_depth;

// Where there is no neighbor the surface goes on straight.
vec2 to_neighbors(ivec2 pixel, ivec2 axis, float a, vec2 window, out bvec2 exist) {
  ivec2 last = ivec2(u_size.xy) - 1;
  ivec2 next = min(pixel + axis, last), previous = max(pixel - axis, ivec2(0));
  vec2 d = vec2(texelFetch(u_values, next, 0).r, texelFetch(u_values, previous, 0).r) - a;
  exist = bvec2(next == pixel + axis && d.x >= -window.x && d.x <= window.y,
                previous == pixel - axis && d.y >= -window.x && d.y <= window.y);
  return vec2(exist.x ? d.x : exist.y ? -d.y : 0.0, exist.y ? d.y : exist.x ? -d.x : 0.0);
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  float a = texelFetch(u_values, pixel, 0).r;
  o_depth = a;
  if (!is_surface(a)) return;
  vec2 window = vec2(farther(a, u_range), nearer(a, u_range));
  bvec2 x_exist, y_exist, up_exist, down_exist;
  vec2 x = to_neighbors(pixel, ivec2(1, 0), a, window, x_exist);
  vec2 y = to_neighbors(pixel, ivec2(0, 1), a, window, y_exist);
  vec2 up = to_neighbors(pixel, ivec2(1, 1), a, window, up_exist);
  vec2 down = to_neighbors(pixel, ivec2(1, -1), a, window, down_exist);
  bool all_exist = all(x_exist) && all(y_exist) && all(up_exist) && all(down_exist);
  float a_xx = x.x + x.y, a_yy = y.x + y.y;
  float a_xy = all_exist ? 0.25 * (up.x + up.y - down.x - down.y) : 0.0;

  // The gradient by the space's own lengths, not by pixels.
  vec2 gradient = 0.5 * u_size.w * vec2(x.x - x.y, y.x - y.y);
  vec2 ray = u_size.z * ray_direction(gl_FragCoord.xy).xy;
  vec3 n = normalize(vec3(gradient, u_size.z > 0.5 ? a - dot(ray, gradient) : 1.0));
  vec2 t = n.xy - n.z * ray;
  float m11 = 1.0 + ray.x * ray.x - t.x * t.x;
  float m12 = ray.x * ray.y - t.x * t.y;
  float m22 = 1.0 + ray.y * ray.y - t.y * t.y;

  float scale = smoothing_share(texelFetch(u_spheres, pixel, 0).r) * pixels_per_meter(depth_of(a));
  float far = 0.5 * (u_stages * u_stages + u_stages);  // in steps of one stage
  float time = min(u_variance * scale * scale, 0.45 * far / (m11 + m22));
  float flow = time / far * (m11 * a_xx + 2.0 * m12 * a_xy + m22 * a_yy);
  float previous = texelFetch(u_previous, pixel, 0).r;
  o_depth = (2.0 * u_j - 1.0) / u_j * (a + flow) - (u_j - 1.0) / u_j * previous;
}
