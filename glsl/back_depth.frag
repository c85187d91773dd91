// back_depth.frag: in: sphere. Out: affine depth of its far side, for MIN blending.
flat in vec4 v_sphere;  // center in eye space and radius [m]
layout(location = 0) out float o_back;

void main() { o_back = back_of(hit_sphere(gl_FragCoord.xy, v_sphere.xyz, v_sphere.w)); }
