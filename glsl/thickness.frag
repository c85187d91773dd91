// thickness.frag: in: sprite. Out: its share of the length of fluid along the ray [m], for ADD
// blending.
flat in float v_share;  // particle's volume / sphere's volume
layout(location = 0) out float o_thickness;

void main() {
  Hit hit = hit_sprite(gl_FragCoord.xy);
  o_thickness = max(hit.chord, 0.0) * v_share;
}
