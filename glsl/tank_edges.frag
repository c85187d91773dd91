// tank_edges.frag: in: smoothed affine depth, smoothed thickness [m]. Out: an edge of the tank,
// linear, multiplied by alpha, to be blended over the picture. Behind fluid it is seen through it.
uniform sampler2D u_depth;
uniform sampler2D u_thickness;
#ifdef MESHES
uniform sampler2D u_mesh_depth;  // affine
#endif
uniform vec3 u_absorption;   // [1/m]
uniform int u_opaque;        // 1: nothing is seen through
uniform float u_half_width;  // [pixels]
noperspective in float v_across;
noperspective in float v_depth;
layout(location = 0) out vec4 o_color;

const vec3 EDGE = vec3(0.022, 0.033, 0.043);

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  float a = texelFetch(u_depth, pixel, 0).r;
  float alpha = 0.72 * clamp(u_half_width - abs(v_across), 0.0, 1.0);
  if (is_surface(a) && depth_of(a) < depth_of(v_depth)) {
    vec3 left = exp(-u_absorption * texelFetch(u_thickness, pixel, 0).r);
    alpha *= u_opaque == 1 ? 0.0 : 0.8 * dot(left, vec3(0.2126, 0.7152, 0.0722));
  }
#ifdef MESHES
  if (texelFetch(u_mesh_depth, pixel, 0).r > v_depth) alpha = 0.0;
#endif
  o_color = alpha * vec4(EDGE, 1.0);
}
