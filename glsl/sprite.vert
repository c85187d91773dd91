// sprite.vert: a quad around the exact outline of each sphere. In: positions [m].
// Counter-clockwise, so that culled back faces cost nothing.
in vec3 a_position;
flat out vec3 v_center;  // eye space [m]
uniform float u_radius;  // [m]

// Least and greatest slope x/depth of the part of a circle (center x, depth z) that lies beyond the
// near plane, seen from the origin: tangents, or where the circle meets the plane (Mara & McGuire
// 2013).
vec2 slopes(float x, float z, float near) {
  float cut = sqrt(max(u_radius * u_radius - (near - z) * (near - z), 0.0));
  vec2 result = vec2(x - cut, x + cut) / near;
  float length2 = x * x + z * z;
  float tangent2 = length2 - u_radius * u_radius;
  if (tangent2 > 0.0) {
    float t = sqrt(tangent2);
    vec2 across = vec2(x * t - z * u_radius, x * t + z * u_radius);
    vec2 along = vec2(z * t + x * u_radius, z * t - x * u_radius);
    if (along.x * t >= near * length2) result.x = across.x / along.x;
    if (along.y * t >= near * length2) result.y = across.y / along.y;
  }
  return result;
}

void main() {
  v_center = (u_view * vec4(a_position, 1.0)).xyz;
  float near = u_lens.z;
  if (-v_center.z + u_radius <= near || -v_center.z - u_radius >= u_lens.w) {
    gl_Position = vec4(2.0, 2.0, 0.0, 1.0);
    return;
  }
  vec2 low = v_center.xy - u_radius;
  vec2 high = v_center.xy + u_radius;
  if (u_size.z > 0.5) {
    vec2 x = slopes(v_center.x, -v_center.z, near);
    vec2 y = slopes(v_center.y, -v_center.z, near);
    low = vec2(x.x, y.x);
    high = vec2(x.y, y.y);
  }
  // A hundredth of a pixel of margin for rounding; beyond the picture there is nothing to draw.
  vec2 margin = 0.02 / u_size.xy;
  low = clamp(low / u_lens.xy - margin, -1.0, 1.0);
  high = clamp(high / u_lens.xy + margin, -1.0, 1.0);
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  gl_Position = vec4(mix(low, high, corner), 0.0, 1.0);
}
