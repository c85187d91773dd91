// sphere_depth.frag: in: sphere. Out: affine depth of its front, for MAX blending. With THICKNESS
// also the thickness, for ADD blending: the pass of both where a driver blends each target in its
// own way (OpenGL 4.0).
flat in vec3 v_center;   // eye space [m]
uniform float u_radius;  // [m]
layout(location = 0) out float o_depth;
#ifdef THICKNESS
uniform float u_volume_share;  // particle's volume / sprite's volume
layout(location = 1) out float o_thickness;  // [m]
#endif

void main() {
  Hit hit = hit_sphere(gl_FragCoord.xy, v_center, u_radius);
  bool seen = hit.chord > 0.0 && hit.front >= u_lens.z;
  // No discard: neutral values of the blending cost less.
  o_depth = seen ? affine_depth(hit.front) : NOTHING;
#ifdef THICKNESS
  o_thickness = max(hit.chord, 0.0) * u_volume_share;
#endif
}
