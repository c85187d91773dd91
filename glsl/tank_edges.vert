// tank_edges.vert: the twelve edges of the tank, each a band of constant width in pixels around its
// line, cut at the near plane. One instance per edge.
uniform vec3 u_tank_lower;  // world space [m]
uniform vec3 u_tank_upper;
uniform float u_half_width;  // [pixels], the soft margin included
noperspective out float v_across;  // [pixels] from the line
noperspective out float v_depth;   // affine depth

vec3 corner(int index) {
  vec3 share = vec3(index & 1, (index >> 1) & 1, (index >> 2) & 1);
  return (u_view * vec4(mix(u_tank_lower, u_tank_upper, share), 1.0)).xyz;
}

void main() {
  // Edge k runs along axis k / 4; its other two coordinates are the bits of k % 4.
  int axis = gl_InstanceID / 4;
  int bits = gl_InstanceID % 4;
  int first = axis == 0 ? bits << 1 : axis == 1 ? (bits & 1) | ((bits & 2) << 1) : bits;
  vec3 p = corner(first);
  vec3 q = corner(first | (1 << axis));
  float near = u_lens.z;
  if (-p.z < near && -q.z < near) {
    gl_Position = vec4(2.0, 2.0, 0.0, 1.0);
    return;
  }
  if (-p.z < near) p = mix(p, q, (near + p.z) / (p.z - q.z));
  if (-q.z < near) q = mix(q, p, (near + q.z) / (q.z - p.z));
  vec2 a = pixel_of(p);
  vec2 b = pixel_of(q);
  vec2 along = normalize(b - a + vec2(1e-6, 0.0));
  bool at_end = (gl_VertexID & 1) == 1;
  float side = (gl_VertexID & 2) == 2 ? 1.0 : -1.0;
  vec2 at = (at_end ? b : a) + side * u_half_width * vec2(-along.y, along.x);
  v_across = side * u_half_width;
  v_depth = affine_depth(-(at_end ? q.z : p.z));
  gl_Position = vec4(2.0 * at / u_size.xy - 1.0, 0.0, 1.0);
}
