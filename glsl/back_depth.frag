// back_depth.frag: in: sprite. Out: affine depth of its far side, for MIN blending. Drops alone
// have none: what they do to a ray their sphere says (composite.frag), and behind a body they would
// be taken for its far side.
flat in float v_crowding;
layout(location = 0) out float o_back;

void main() {
  o_back = is_alone(v_crowding) ? -NOTHING : back_of(hit_sprite(gl_FragCoord.xy));
}
