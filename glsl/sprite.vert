// sprite.vert: a quad around the exact outline of each sphere. In: position [m] and crowding, 0 for
// a drop alone to 1 in a body of fluid.
in vec4 a_particle;
flat out vec4 v_sphere;        // center in eye space and radius [m]
flat out float v_crowding;
flat out float v_share;        // particle's volume / sphere's volume
uniform float u_radius;        // in a body of fluid [m]
uniform float u_drop_radius;   // alone [m]
uniform float u_volume;        // of a particle [m^3]

void main() {
  vec3 center = (u_view * vec4(a_particle.xyz, 1.0)).xyz;
  v_crowding = a_particle.w;
  float radius = mix(u_drop_radius, u_radius, v_crowding);
  v_sphere = vec4(center, radius);
  v_share = u_volume / (4.18879020 * radius * radius * radius);
  gl_Position = outline_corner(center, radius);
}
