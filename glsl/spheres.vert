// spheres.vert: a quad around each particle's sphere. In: position [m], and color as color.glsl
// packs it. With LINEAR the color comes out unpacked.
in vec4 a_particle;
flat out vec4 v_sphere;  // center in eye space and radius [m]
#ifdef LINEAR
flat out vec3 v_color;
#else
flat out float v_color;  // packed
#endif
uniform float u_radius;  // [m]

void main() {
  vec3 center = (u_view * vec4(a_particle.xyz, 1.0)).xyz;
  v_sphere = vec4(center, u_radius);
#ifdef LINEAR
  v_color = linear_color(a_particle.w);
#else
  v_color = a_particle.w;
#endif
  gl_Position = outline_corner(center, u_radius);
}
