// sphere_outline.glsl: a rectangle of the picture around the exact outline of a sphere.
// Least and greatest slope x/depth of the part of a circle (center x, depth z) that lies beyond the
// near plane, seen from the origin: tangents, or where the circle meets the plane (Mara & McGuire
// 2013).
vec2 slopes(float x, float z, float radius, float near) {
  float cut = sqrt(max(radius * radius - (near - z) * (near - z), 0.0));
  vec2 result = vec2(x - cut, x + cut) / near;
  float length2 = x * x + z * z;
  float tangent2 = length2 - radius * radius;
  if (tangent2 > 0.0) {
    float t = sqrt(tangent2);
    vec2 across = vec2(x * t - z * radius, x * t + z * radius);
    vec2 along = vec2(z * t + x * radius, z * t - x * radius);
    if (along.x * t >= near * length2) result.x = across.x / along.x;
    if (along.y * t >= near * length2) result.y = across.y / along.y;
  }
  return result;
}

// Its lower left and upper right corner, -1 to 1 across the picture; out of sight if the sphere
// (center in eye space) [m] is.
vec4 outline(vec3 center, float radius) {
  float near = u_lens.z;
  if (-center.z + radius <= near || -center.z - radius >= u_lens.w) {
    return vec4(2.0);
  }
  vec2 low = center.xy - radius;
  vec2 high = center.xy + radius;
  if (u_size.z > 0.5) {
    vec2 x = slopes(center.x, -center.z, radius, near);
    vec2 y = slopes(center.y, -center.z, radius, near);
    low = vec2(x.x, y.x);
    high = vec2(x.y, y.y);
  }
  // A hundredth of a pixel of margin for rounding; beyond the picture there is nothing to draw.
  vec2 margin = 0.02 / u_size.xy;
  low = clamp(low / u_lens.xy - margin, -1.0, 1.0);
  high = clamp(high / u_lens.xy + margin, -1.0, 1.0);
  return vec4(low, high);
}

// Position of a vertex of a quad, counter-clockwise, so that culled back faces cost nothing.
vec4 outline_corner(vec3 center, float radius) {
  vec4 box = outline(center, radius);
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  return vec4(mix(box.xy, box.zw, corner), 0.0, 1.0);
}
