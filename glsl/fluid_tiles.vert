// fluid_tiles.vert: a counter-clockwise square of the picture. In: corner and side [pixels].
in vec3 a_position;
void main() {
  vec2 pixel = a_position.xy + a_position.z * vec2(gl_VertexID & 1, gl_VertexID >> 1);
  gl_Position = vec4(2.0 * pixel / u_size.xy - 1.0, 0.0, 1.0);
}
