// spheres.vert: a quad around each particle's sphere. In: position [m], and color as color.glsl
// packs it. With TINT the color comes out unpacked, and spheres so far behind the fluid's surface
// that they cannot tint it are not drawn; with POINTS the quad is a point's square.
in vec4 a_particle;
flat out vec4 v_sphere;  // center in eye space and radius [m]
#ifdef TINT
uniform sampler2D u_depth;  // affine depth of the surface
flat out vec3 v_color;
#else
flat out float v_color;  // packed
#endif
uniform float u_radius;  // [m]
uniform vec3 u_target_size;  // [pixels]

#ifdef TINT
// Whether the surface is more than five radii in front of the sphere, at its middle and around: a
// weight of exp(-5) in tint.frag. Most particles of a body are.
bool is_deep(vec3 center, vec4 box) {
  bool deep = true;
  for (int k = 0; k < 5; ++k) {
    vec2 share = k == 4 ? vec2(0.5) : vec2(k & 1, k >> 1);
    vec2 at = (0.5 * mix(box.xy, box.zw, share) + 0.5) * u_size.xy;
    float a = texelFetch(u_depth, clamp(ivec2(at), ivec2(0), ivec2(u_size.xy) - 1), 0).r;
    deep = deep && is_surface(a) && -center.z - depth_of(a) > 6.0 * u_radius;
  }
  return deep;
}
#endif

void main() {
  vec3 center = (u_view * vec4(a_particle.xyz, 1.0)).xyz;
  v_sphere = vec4(center, u_radius);
#ifdef TINT
  v_color = linear_color(a_particle.w);
#else
  v_color = a_particle.w;
#endif
#ifdef POINTS
  vec4 box = outline(center, u_radius);
  vec2 size = (box.zw - box.xy) * 0.5 * u_target_size.xy;
  gl_Position = vec4(0.5 * (box.xy + box.zw), 0.0, 1.0);
  gl_PointSize = max(max(size.x, size.y), 1.0);
#else
  gl_Position = box_corner(outline(center, u_radius));
#endif
#ifdef TINT
  if (is_deep(center, outline(center, u_radius))) gl_Position = vec4(2.0, 2.0, 0.0, 1.0);
#endif
}
