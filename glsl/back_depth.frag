// back_depth.frag: in: sprite. Out: affine depth of its far side, for MIN blending.
layout(location = 0) out float o_back;

void main() { o_back = back_of(hit_sprite(gl_FragCoord.xy)); }
