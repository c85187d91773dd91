// opaque_meshes.vert: in: a triangle's corner in world space [m]. Greater depth is nearer.
in vec3 a_position;
out vec3 v_position;  // eye space [m]

void main() {
  v_position = (u_view * vec4(a_position, 1.0)).xyz;
  float near = u_lens.z;
  float far = u_lens.w;
  float z = v_position.z;
  // 1 at the near and -1 at the far plane, once divided by w.
  vec2 depth = u_size.z > 0.5
                   ? vec2(((far + near) * z + 2.0 * far * near) / (far - near), -z)
                   : vec2((2.0 * z + far + near) / (far - near), 1.0);
  gl_Position = vec4(v_position.xy / u_lens.xy, depth);
}
