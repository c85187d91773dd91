// smooth.glsl: one axis of a smoothing filter. At each pixel a straight line is fitted to the
// neighbors along the axis by weighted least squares; its value at the pixel is the result. A
// constant and a tilted plane are therefore kept exactly, also beside a hole or the border, where
// only some neighbors exist.
//
// Weights: exp(-k^2 / (2 s^2)) in space, k the distance and s = radius / 2 in pixels, fading out
// over the last pixel so that nothing pops when the radius changes. The bilateral filter multiplies
// by (1 - u^2)^2, u the difference of values over the range: 0 from the range on, so that a higher
// step is kept untouched.
uniform sampler2D u_values;
uniform ivec2 u_axis;    // (1, 0) or (0, 1)
uniform int u_gaussian;  // 1: no range weight
uniform float u_empty;   // neighbors with this value or less do not exist: no fluid

// More neighbors to a side than this are thinned out evenly: a kernel that wide covers many pixels
// of each sphere and sees the same surface.
const float MOST_TAPS = 24.0;

// @param range  inverse widths of the window of values, below and above the pixel's own
float smoothed(ivec2 pixel, float value, float radius, vec2 inverse_range) {
  ivec2 size = textureSize(u_values, 0);
  int at = pixel.x * u_axis.x + pixel.y * u_axis.y;
  int last = size.x * u_axis.x + size.y * u_axis.y - 1;
  float stride = max(radius / MOST_TAPS, 1.0);
  float reach = radius / stride;
  int taps = int(ceil(reach));
  // Moments of the weights and of the differences to the pixel's own value.
  float s0 = 1.0, s1 = 0.0, s2 = 0.0, t0 = 0.0, t1 = 0.0;
  float inverse_s2 = 4.0 / (reach * reach);
  float space = 1.0;
  float ratio = exp(-0.5 * inverse_s2);
  float ratio_step = ratio * ratio;
  for (int k = 1; k <= taps; ++k) {
    space *= ratio;  // exp(-k^2 / (2 s^2))
    ratio *= ratio_step;
    float x = floor(float(k) * stride + 0.5);
    int offset = int(x);
    float fade = clamp(reach + 1.0 - float(k), 0.0, 1.0);
    vec2 neighbors = vec2(texelFetch(u_values, pixel + u_axis * min(offset, last - at), 0).r,
                          texelFetch(u_values, pixel - u_axis * min(offset, at), 0).r);
    bvec2 exist = bvec2(offset <= last - at && neighbors.x > u_empty,
                        offset <= at && neighbors.y > u_empty);
    vec2 difference = mix(vec2(0.0), neighbors - value, exist);
    vec2 weight = vec2(exist) * (space * fade);
    if (u_gaussian == 0) {
      vec2 u = max(-difference * inverse_range.x, difference * inverse_range.y);
      vec2 keep = max(1.0 - u * u, 0.0);
      weight *= keep * keep;
    }
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
