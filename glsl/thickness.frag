// thickness.frag: in: sphere. Out: its share of the length of fluid along the ray [m], for ADD
// blending.
flat in vec4 v_sphere;  // center in eye space and radius [m]
flat in float v_share;  // particle's volume / sphere's volume
layout(location = 0) out float o_thickness;

void main() {
  Hit hit = hit_sphere(gl_FragCoord.xy, v_sphere.xyz, v_sphere.w);
  o_thickness = max(hit.chord, 0.0) * v_share;
}
