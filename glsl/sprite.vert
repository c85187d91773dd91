// sprite.vert: a quad around the exact outline of each sphere, with ELLIPSOIDS of each ellipsoid.
// In: position [m] and crowding, 0 for a drop alone to 1 in a body of fluid.
layout(location = 0) in vec4 a_particle;
#ifdef ELLIPSOIDS
// The symmetric matrix of determinant 1 that makes the ellipsoid of the sphere.
layout(location = 1) in vec4 a_stretch_diagonal;  // xx, yy, zz
layout(location = 2) in vec4 a_stretch_beside;    // xy, xz, yz
flat out mat3 v_to_sphere;
#endif
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
#ifdef ELLIPSOIDS
  vec3 d = a_stretch_diagonal.xyz, b = a_stretch_beside.xyz;
  mat3 view = mat3(u_view);
  mat3 stretch = view * mat3(d.x, b.x, b.y, b.x, d.y, b.z, b.y, b.z, d.z) * transpose(view);
  // The adjugate is the inverse where the determinant is 1.
  v_to_sphere = mat3(cross(stretch[1], stretch[2]), cross(stretch[2], stretch[0]),
                     cross(stretch[0], stretch[1]));
  gl_Position = box_corner(ellipsoid_outline(center, radius * radius * (stretch * stretch)));
#else
  gl_Position = box_corner(outline(center, radius));
#endif
}
