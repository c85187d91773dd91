// display.glsl: from linear light to what a screen expects.
uniform float u_exposure;

// Values below 0.8 stay what they are; brighter ones approach 1.
vec3 tone(vec3 c) {
  vec3 over = max(c - 0.8, 0.0);
  return min(c, 0.8) + 0.2 * over / (over + 0.2);
}

vec3 srgb(vec3 c) {
  vec3 curved = 1.055 * pow(max(c, 1e-5), vec3(1.0 / 2.4)) - 0.055;
  return mix(12.92 * c, curved, greaterThan(c, vec3(0.0031308)));
}

vec4 display(vec3 color) { return vec4(srgb(tone(color * u_exposure)), 1.0); }
