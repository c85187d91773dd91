// sphere_outline.glsl: a rectangle of the picture around the exact outline of a sphere or an
// ellipsoid: its lower left and upper right corner, -1 to 1 across the picture.

const vec4 OUT_OF_SIGHT = vec4(2.0);

// Of what has these slopes (perspective) or coordinates [m].
vec4 box_of(vec2 low, vec2 high) {
  // A hundredth of a pixel of margin for rounding; beyond the picture there is nothing to draw.
  vec2 margin = 0.02 / u_size.xy;
  return vec4(clamp(low / u_lens.xy - margin, -1.0, 1.0),
              clamp(high / u_lens.xy + margin, -1.0, 1.0));
}

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

// Of a sphere (center in eye space) [m].
vec4 outline(vec3 center, float radius) {
  float near = u_lens.z;
  if (-center.z + radius <= near || -center.z - radius >= u_lens.w) {
    return OUT_OF_SIGHT;
  }
  vec2 low = center.xy - radius;
  vec2 high = center.xy + radius;
  if (u_size.z > 0.5) {
    vec2 x = slopes(center.x, -center.z, radius, near);
    vec2 y = slopes(center.y, -center.z, radius, near);
    low = vec2(x.x, y.x);
    high = vec2(x.y, y.y);
  }
  return box_of(low, high);
}

// The same of an ellipsoid of all center + v with v^T A^-1 v <= 1, by its center and A: the planes
// through the origin that touch it are x = s z with (x - s z)^2 = xx - 2 s xz + s^2 zz.
vec2 slopes(float x, float z, float xx, float zz, float xz) {
  // Squares of differences of what is near to one another would lose the digits that matter.
  float root2 = z * z * xx - 2.0 * (x * z) * xz + x * x * zz - (xx * zz - xz * xz);
  float root = sqrt(max(root2, 0.0));
  return vec2(x * z - xz - root, x * z - xz + root) / (z * z - zz);
}

// Of such an ellipsoid.
vec4 ellipsoid_outline(vec3 center, mat3 A) {
  float depth = -center.z;
  vec3 half_size = sqrt(vec3(A[0][0], A[1][1], A[2][2]));
  if (depth + half_size.z <= u_lens.z || depth - half_size.z >= u_lens.w) return OUT_OF_SIGHT;
  if (u_size.z < 0.5) return box_of(center.xy - half_size.xy, center.xy + half_size.xy);
  // Cut by the near plane: a sphere around it.
  if (depth - half_size.z < u_lens.z) return outline(center, length(half_size));
  vec2 x = slopes(center.x, depth, A[0][0], A[2][2], -A[2][0]);
  vec2 y = slopes(center.y, depth, A[1][1], A[2][2], -A[2][1]);
  return box_of(vec2(x.x, y.x), vec2(x.y, y.y));
}

// Position of a vertex of a quad, counter-clockwise, so that culled back faces cost nothing.
vec4 box_corner(vec4 box) {
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  return vec4(mix(box.xy, box.zw, corner), 0.0, 1.0);
}
