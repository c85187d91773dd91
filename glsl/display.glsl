// display.glsl: from light in the scene to what a screen shows, still linear: targets encode sRGB.
// TONE is the name of one of the curves.
uniform float u_exposure;

vec3 tone_none(vec3 c) { return min(c, 1.0); }

// Values below 0.8 stay what they are; brighter ones approach 1.
vec3 tone_soft(vec3 c) {
  vec3 over = max(c - 0.8, 0.0);
  return min(c, 0.8) + 0.2 * over / (over + 0.2);
}

// The curve of film that the motion picture academy's system has, as a quotient (Narkowicz's fit).
vec3 tone_aces(vec3 c) {
  return clamp(c * (2.51 * c + 0.03) / (c * (2.43 * c + 0.59) + 0.14), 0.0, 1.0);
}

// @param light  multiplied by alpha. Light that is added to what is behind, as mirrors add it,
//               counts as opaque to the extent that it is bright: alpha is never less than a color.
vec4 display(vec3 light, float alpha) {
  vec3 color = TONE(max(light * u_exposure, 0.0));
  return vec4(color, max(alpha, max(color.r, max(color.g, color.b))));
}
