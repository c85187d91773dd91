// thickness.frag: in: sphere. Out: its share of the length of fluid along the ray [m], for ADD
// blending.
flat in vec3 v_center;         // eye space [m]
uniform float u_radius;        // [m]
uniform float u_volume_share;  // particle's volume / sprite's volume
layout(location = 0) out float o_thickness;

void main() {
  Hit hit = hit_sphere(gl_FragCoord.xy, v_center, u_radius);
  o_thickness = max(hit.chord, 0.0) * u_volume_share;
}
