// sphere_hit.glsl: where a pixel's viewing ray passes through a sphere or an ellipsoid.
struct Hit {
  float front;  // depth where the ray enters [m]
  float back;   // depth where it leaves [m]
  float chord;  // length inside, between the near and the far plane [m]; <= 0: missed
};

// Affine depth of the far side, for MIN blending.
float back_of(Hit hit) {
  return hit.chord > 0.0 ? affine_depth(min(hit.back, u_lens.w)) : -NOTHING;
}

// A ray from the origin against a sphere; the chord as long as if `direction` were 1.
Hit hit_from_origin(vec3 direction, vec3 center, float radius) {
  float scale2 = dot(direction, direction);
  // From the point of the ray nearest to the center: the textbook quadratic loses the digits that
  // matter.
  float middle = dot(direction, center) / scale2;
  vec3 miss = center - middle * direction;
  float half2 = radius * radius - dot(miss, miss);
  if (half2 <= 0.0) return Hit(0.0, 0.0, 0.0);
  float half_depth = sqrt(half2 / scale2);
  float front = middle - half_depth;
  float back = middle + half_depth;
  return Hit(front, back, min(back, u_lens.w) - max(front, u_lens.z));
}

// @param to_sphere  makes the sphere of the radius of the ellipsoid
Hit hit_ellipsoid(vec2 pixel, vec3 center, float radius, mat3 to_sphere) {
  vec3 direction = ray_direction(pixel);
  vec3 offset = center - ray_origin(pixel);
  Hit hit = hit_from_origin(to_sphere * direction, to_sphere * offset, radius);
  hit.chord *= length(direction);
  return hit;
}

Hit hit_sphere(vec2 pixel, vec3 center, float radius) {
  vec3 direction = ray_direction(pixel);
  Hit hit = hit_from_origin(direction, center - ray_origin(pixel), radius);
  hit.chord *= length(direction);
  return hit;
}
