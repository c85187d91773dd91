// color.glsl: a particle's color, 0xrrggbb, sRGB-encoded, in the digits of a float between 0.5 and
// 2, of which no driver takes a bit away as it may of denormal numbers and NaN.
vec3 linear_color(float packed_color) {
  uint bits = floatBitsToUint(packed_color);
  vec3 c = vec3(uvec3(bits >> 16, bits >> 8, bits) & 255u) / 255.0;
  vec3 curved = pow((c + 0.055) / 1.055, vec3(2.4));
  return mix(c / 12.92, curved, greaterThan(c, vec3(0.04045)));
}
