// spheres.vert: a quad around each particle's sphere. In: position [m], and color as color.glsl
// packs it. With LINEAR the color comes out unpacked, with POINTS the quad is a point's square.
in vec4 a_particle;
flat out vec4 v_sphere;  // center in eye space and radius [m]
#ifdef LINEAR
flat out vec3 v_color;
#else
flat out float v_color;  // packed
#endif
uniform float u_radius;  // [m]
uniform vec3 u_target_size;  // [pixels]

void main() {
  vec3 center = (u_view * vec4(a_particle.xyz, 1.0)).xyz;
  v_sphere = vec4(center, u_radius);
#ifdef LINEAR
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
  gl_Position = outline_corner(center, u_radius);
#endif
}
