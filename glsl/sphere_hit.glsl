// sphere_hit.glsl: where a pixel's viewing ray passes through a sphere.
struct Hit {
  float front;  // depth where the ray enters [m]
  float back;   // depth where it leaves [m]
  float chord;  // length inside, between the near and the far plane [m]; <= 0: missed
};

// Affine depth of the far side, for MIN blending.
float back_of(Hit hit) {
  return hit.chord > 0.0 ? affine_depth(min(hit.back, u_lens.w)) : -NOTHING;
}

Hit hit_sphere(vec2 pixel, vec3 center, float radius) {
  vec3 origin = ray_origin(pixel);
  vec3 direction = ray_direction(pixel);
  float scale2 = dot(direction, direction);
  // From the point of the ray nearest to the center: the textbook quadratic loses the digits that
  // matter.
  float middle = dot(direction, center - origin) / scale2;
  vec3 miss = center - origin - middle * direction;
  float half2 = radius * radius - dot(miss, miss);
  if (half2 <= 0.0) return Hit(0.0, 0.0, 0.0);
  float half_depth = sqrt(half2 / scale2);
  float front = middle - half_depth;
  float back = middle + half_depth;
  float inside = min(back, u_lens.w) - max(front, u_lens.z);
  return Hit(front, back, inside * sqrt(scale2));
}
