// spheres.frag: in: sphere. Out: affine depth and unit normal (eye space) where the viewing ray
// enters it, and its color, packed; the depth buffer lets the nearest sphere stay.
flat in vec4 v_sphere;  // center in eye space and radius [m]
flat in float v_color;
layout(location = 0) out float o_depth;
layout(location = 1) out vec4 o_surface;

void main() {
  Hit hit = hit_sphere(gl_FragCoord.xy, v_sphere.xyz, v_sphere.w);
  bool seen = hit.chord > 0.0 && hit.front >= u_lens.z;
  float depth = seen ? hit.front : 1.0;
  vec3 p = eye_position(gl_FragCoord.xy, depth);
  o_depth = affine_depth(depth);
  o_surface = vec4((p - v_sphere.xyz) / v_sphere.w, v_color);
  // As the buffer is cleared to 0 and keeps what is greater, 0 is never drawn: no discard. Falling
  // with the distance, the number has the same relative precision everywhere.
  gl_FragDepth = seen ? u_lens.z / depth : 0.0;
}
