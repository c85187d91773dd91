// smooth.frag: one axis of a smoothing filter. In: a layer, affine depth or thickness [m], and the
// affine depth of the spheres with their crowding. Out: the layer. Affine depth of fronts carries
// its crowding from pass to pass.
//
// At each pixel a straight line is fitted to the neighbors along the axis by weighted least
// squares; its value at the pixel is the result. A constant and a tilted plane are therefore kept
// exactly, also beside a hole or the border, where only some neighbors exist.
//
// Weights: exp(-k^2 / (2 s^2)) in space, k the distance and s = radius / 2 in pixels, fading out
// over the last pixel so that nothing pops when the radius changes. Which neighbors count:
//   GAUSSIAN      all; of far sides those behind the pixel's front: what ends before it is another
//                 body's
//   BILATERAL     times (1 - u^2)^2, u the difference of values over the range: 0 from the range
//                 on, so that a higher step is kept untouched
//   NARROW_RANGE  those within a window of values that begins as the range and grows with what it
//                 takes in, so that a steep surface passes [TY18]. A neighbor in front of the
//                 window drops out together with its mirror image; one behind it counts as a
//                 little behind the pixel, which rounds off the edge of what is in front. Pairs
//                 are visited from the pixel outwards; what lies beyond a hole does not count,
//                 for the window could not grow there.
// To these two a drop before a body is another surface, however near: it stays as it is, and would
// pull the body towards itself, in streaks along both axes.
// Neighbors of a kernel wider than MOST_TAPS are thinned out evenly: it covers many pixels of each
// sphere and sees the same surface. Beside an edge, though, pixels in between see other neighbors
// than their own; a last, dense pass over as many pixels as were left out joins them.
//
// raster/smooth_lanes.cpp is this file in C++.
uniform sampler2D u_values;
uniform sampler2D u_spheres;
uniform ivec2 u_axis;     // (1, 0) or (0, 1)
uniform int u_thickness;  // 1: the layer is thickness
uniform int u_far_side;   // 1: the layer is the far side's affine depth
uniform float u_radius;   // where the kernel ends [m]; of depth: in a body of fluid
uniform float u_range;    // [m]
uniform float u_behind;   // [m]
uniform int u_close_gaps; // 1: the last pass, over what thinning out has left
layout(location = 0) out float o_value;

const float MOST_TAPS = 24.0;
const float MOST_PIXELS = 65536.0;  // of a radius: wider than any picture

// Lengths of the layer's own kind, all positive: down and up to the ends of the window, and to
// where narrow_range puts what is below.
struct Window {
  float down, up, behind;
};

float stride_of(float radius) { return max(ceil(radius / MOST_TAPS), 1.0); }
float gap_radius(float radius) {
  float stride = stride_of(radius);
  return stride > 1.0 ? 1.5 * stride : 0.0;
}

// @param limit    what is more does not count
// @param strange  bits of depth that only another surface has
float smoothed(
    ivec2 pixel, float value, float radius, Window window, float limit, uint strange) {
  ivec2 size = textureSize(u_values, 0);
  int at = pixel.x * u_axis.x + pixel.y * u_axis.y;
  int last = size.x * u_axis.x + size.y * u_axis.y - 1;
  float empty = u_thickness == 1 ? 0.0 : LEAST_SURFACE;
  float stride = stride_of(radius);
  float reach = radius / stride;
  int taps = int(ceil(reach));
  // Moments of the weights and of the differences to the pixel's own value; distances in strides.
  float s0 = 1.0, s1 = 0.0, s2 = 0.0, t0 = 0.0, t1 = 0.0;
  float space = 1.0;
  float ratio = exp(-2.0 / (reach * reach));
  float ratio_step = ratio * ratio;
  float inverse_down = 1.0 / window.down, inverse_up = 1.0 / window.up;
  float low = -window.down, high = window.up;
  bvec2 open = bvec2(true);
  for (int k = 1; k <= taps; ++k) {
    space *= ratio;  // exp(-k^2 / (2 s^2))
    ratio *= ratio_step;
    float x = float(k);
    int offset = k * int(stride);
    float fade = clamp(reach + 1.0 - x, 0.0, 1.0);
    vec2 neighbors = vec2(texelFetch(u_values, pixel + u_axis * min(offset, last - at), 0).r,
                          texelFetch(u_values, pixel - u_axis * min(offset, at), 0).r);
    bvec2 exist = bvec2(offset <= last - at && neighbors.x > empty && neighbors.x < limit,
                        offset <= at && neighbors.y > empty && neighbors.y < limit);
#if defined(NARROW_RANGE)
    exist = open = bvec2(open.x && exist.x, open.y && exist.y);
#endif
#if !defined(GAUSSIAN)
    uvec2 theirs = floatBitsToUint(neighbors) & strange;
    bvec2 other = bvec2(exist.x && theirs.x != 0u, exist.y && theirs.y != 0u);
#endif
    vec2 difference = mix(vec2(0.0), neighbors - value, exist);
    vec2 weight = vec2(exist) * (space * fade);
#if defined(BILATERAL)
    vec2 u = max(-difference * inverse_down, difference * inverse_up);
    vec2 keep = max(1.0 - u * u, 0.0);
    weight *= keep * keep * vec2(not(other));
#elif defined(NARROW_RANGE)
    bool in_front = max(difference.x, difference.y) > high || any(other);
    vec2 inside = mix(difference, vec2(0.0), lessThan(difference, vec2(low)));
    difference = mix(difference, vec2(-window.behind), lessThan(difference, vec2(low)));
    weight *= in_front ? 0.0 : 1.0;
    high = in_front ? high : max(high, max(inside.x, inside.y) + window.up);
    low = in_front ? low : min(low, min(inside.x, inside.y) - window.down);
#endif
    vec2 moment = weight * difference;
    s0 += weight.x + weight.y;
    s1 += x * (weight.x - weight.y);
    s2 += x * x * (weight.x + weight.y);
    t0 += moment.x + moment.y;
    t1 += x * (moment.x - moment.y);
  }
  float determinant = s0 * s2 - s1 * s1;
  return determinant > 1e-6 * s0 * s0 ? value + (s2 * t0 - s1 * t1) / determinant : value;
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  float value = texelFetch(u_values, pixel, 0).r;
  float sphere = texelFetch(u_spheres, pixel, 0).r;
  o_value = value;
  float radius = u_radius;
  Window window = Window(u_range, u_range, 0.0);
  if (u_thickness == 1) {
    if (!is_surface(sphere) || value <= 0.0) return;
    radius *= pixels_per_meter(depth_of(sphere));
  } else {
    if (!is_surface(value)) return;
    radius *= smoothing_share(sphere) * pixels_per_meter(depth_of(value));
    window = Window(farther(value, u_range), nearer(value, u_range), farther(value, u_behind));
  }
  radius = min(radius, MOST_PIXELS);
  if (u_close_gaps == 1) radius = gap_radius(radius);
  if (radius <= 0.0) return;
  float limit = u_far_side == 1 ? sphere : -LEAST_SURFACE;
  uint strange = u_thickness == 0 && is_body(sphere) ? DROP : 0u;
  float result = smoothed(pixel, value, radius, window, limit, strange);
  if (u_thickness == 1) {
    o_value = max(result, 0.0);
  } else {
    o_value = u_far_side == 1 ? result : with_crowding_of(result, sphere);
  }
}
