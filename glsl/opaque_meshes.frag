// opaque_meshes.frag: in: a point of a triangle. Out: its color for the picture, its light for rays
// through the fluid, and its affine depth.
in vec3 v_position;    // eye space [m]
uniform vec3 u_color;  // linear
layout(location = 0) out vec4 o_color;
layout(location = 1) out vec4 o_light;
layout(location = 2) out float o_depth;

void main() {
  vec3 point = u_eye + to_world(v_position);
  if (is_below_floor(point)) discard;
  vec3 n = to_world(normalize(cross(dFdx(v_position), dFdy(v_position))));
  // As much as the floor gets, if it faces up.
  float sky = 0.35 + 0.2 * dot(n, u_up);
  float sun = 0.45 * max(dot(n, u_sun), 0.0) / max(dot(u_up, u_sun), 0.3);
  o_light = vec4(u_color * (sky + sun), 1.0);
  o_color = display(o_light.rgb, 1.0);
  o_depth = affine_depth(-v_position.z);
}
