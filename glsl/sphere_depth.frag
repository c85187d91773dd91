// sphere_depth.frag: in: sprite. Out: affine depth of its front with its crowding, for MAX
// blending. With ALL also thickness, for ADD blending, and affine depth of its far side, for MIN
// blending: the pass of all where a driver blends each target in its own way (OpenGL 4.0). Drops
// alone have no far side (back_depth.frag).
flat in float v_crowding;
layout(location = 0) out float o_depth;
#ifdef ALL
flat in float v_share;  // particle's volume / sphere's volume
layout(location = 1) out float o_thickness;  // [m]
layout(location = 2) out float o_back;
#endif

void main() {
  Hit hit = hit_sprite(gl_FragCoord.xy);
  bool seen = hit.chord > 0.0 && hit.front >= u_lens.z;
  // No discard: neutral values of the blending cost less.
  o_depth = seen ? with_crowding(affine_depth(hit.front), v_crowding) : NOTHING;
#ifdef ALL
  o_thickness = max(hit.chord, 0.0) * v_share;
  o_back = is_alone(v_crowding) ? -NOTHING : back_of(hit);
#endif
}
