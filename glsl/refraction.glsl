// refraction.glsl: the ray that is seen through the fluid, bent, mirrored and followed to where it
// leaves.
uniform sampler2D u_depth;         // smoothed affine depth
uniform sampler2D u_thickness;     // [m]
uniform sampler2D u_back;          // smoothed affine depth of the far side
uniform float u_refractive_index;
uniform float u_drop_radius;       // of a lone sprite [m]

const float LEAST_WAY = 1e-4;  // in the fluid; shorter ones count as this [sprites' radii]
const int EXIT_STEPS = 6;      // of a ray that looks for its way out of the fluid
const float FARTHEST = 1.5;    // a bent ray's way to the far side, in that of the straight one
const int BACK_STEPS = 6;      // of one that looks for the far side
const int BOUNCES = 3;         // of a ray in a tank: as many as a corner has walls

// Share of unpolarized light that a smooth dielectric mirrors (Fresnel); c is the cosine of
// incidence.
float fresnel(float c, float index) {
  float g2 = index * index - 1.0 + c * c;
  float g = sqrt(max(g2, 1e-6));
  float a = (g - c) / (g + c);
  float b = (c * (g + c) - 1.0) / (c * (g - c) + 1.0);
  return 0.5 * a * a * (1.0 + b * b);
}

// A ray of light, followed backwards.
struct Ray {
  vec3 at;         // world space [m]
  vec3 direction;  // unit vector
  float way;       // length in the fluid so far [m]
  vec3 first;      // direction behind the surface
};

// Thickness over the length from the front to the far side, without what spheres stick out by
// before and behind: what is less is air between.
// @param end  no farther than this [m]
float filling(float thickness, float length, float end) {
  float sticking_out = min(1.2 * u_radius, 0.5 * length);
  return thickness / max(min(length - sticking_out, end), LEAST_WAY * u_radius);
}

// How far inside the fluid that the picture shows a point of a ray is: negative from a sprite's
// radius outside on, as far as filters move the far side at a wall, and where there is more air
// than fluid between front and far side.
float inside_fluid(Ray ray, float way) {
  vec3 at = mat3(u_view) * (ray.at + way * ray.direction - u_eye);
  ivec2 pixel = ivec2(clamp(pixel_of(at), vec2(0.0), u_size.xy - 1.0));
  float front = texelFetch(u_depth, pixel, 0).r;
  float behind = -at.z - depth_of(front);
  float before = depth_of(texelFetch(u_back, pixel, 0).r) + at.z;
  float length = behind + before;
  float filled = filling(texelFetch(u_thickness, pixel, 0).r, length, length);
  float inside = min(min(behind, before) / u_radius + 1.0, 2.0 * filled - 1.0);
  bool is_fluid = is_surface(front) && at.z < 0.0;
  return is_fluid ? clamp(inside, -1.0, 1.0) : -1.0;
}

// Where along a ray something is left: at `from` it is still inside, at `to` no more, by how far.
struct Bracket {
  float from, to;
  float at_from, at_to;
};
float middle(Bracket b) { return 0.5 * (b.from + b.to); }
Bracket halved(Bracket b, float at_middle) {
  return at_middle > 0.0 ? Bracket(middle(b), b.to, at_middle, b.at_to)
                         : Bracket(b.from, middle(b), b.at_from, at_middle);
}
float crossing(Bracket b) { return mix(b.from, b.to, b.at_from / (b.at_from - b.at_to)); }

// How far a ray goes through the fluid before it leaves it, as far as the picture knows: steps
// that grow until one leads out, whose ends are brought together.
float way_inside(Ray ray, float most) {
  Bracket exit = Bracket(0.0, 0.0, 1.0, 1.0);
  for (int k = 1; k <= EXIT_STEPS && exit.at_to > 0.0; ++k) {
    float to = most * float(k * k) / float(EXIT_STEPS * EXIT_STEPS);
    exit = Bracket(exit.to, to, exit.at_to, inside_fluid(ray, to));
  }
  if (exit.at_to > 0.0) return most;
  for (int k = 0; k < 4; ++k) exit = halved(exit, inside_fluid(ray, middle(exit)));
  return crossing(exit);
}

// On through the fluid to the floor, or out through a wall of the tank; a wall that it meets too
// flat mirrors it. What the bottom mirrors is too flat for a level surface as well, and goes back
// and forth between both as far as the next wall.
void follow_to_wall_or_floor(inout Ray ray) {
  bool inside = true, off_bottom = false;
  for (int k = 0; k < BOUNCES; ++k) {
    vec3 outward;
    float to_floor = distance_to_ground(ray.at, ray.direction);
    float to_wall = distance_to_wall(ray.at, ray.direction, outward);
    float to_end = min(to_floor, to_wall);
    float way = inside && is_met(to_end) ? to_end : 0.0;
    float to_surface = k == 0 || !inside ? way : way_inside(ray, way);
    ray.way += off_bottom ? way : to_surface;
    ray.at += way * ray.direction;
    // Whether it goes up or down when it comes to the wall is the less known the more often it has
    // met the surface by then: the mean of both goes level.
    float steep = min(to_surface / max(way, LEAST_WAY * u_radius), 1.0);
    float level = off_bottom ? 1.0 - steep * steep : 0.0;
    ray.direction = normalize(ray.direction - level * dot(ray.direction, u_up) * u_up);
    vec3 bent = refract(ray.direction, -outward, u_refractive_index);
    bool mirrors = dot(bent, bent) < 0.5;
    inside = inside && to_wall < to_floor;
    if (inside) ray.direction = mirrors ? reflect(ray.direction, outward) : bent;
    inside = inside && mirrors;
    off_bottom = inside && (off_bottom || dot(outward, u_up) < -0.5);
  }
}

// The far side of the fluid at a pixel, in eye space [m]; where there is no fluid, as far away as
// `else_at`.
vec3 back_at(ivec2 pixel, float else_at) {
  pixel = clamp(pixel, ivec2(0), ivec2(u_size.xy) - 1);
  float a = texelFetch(u_back, pixel, 0).r;
  return eye_position(vec2(pixel) + 0.5, is_surface(a) ? depth_of(a) : else_at);
}

// Its normal, towards the viewer, from points about a sprite apart. A step of depth is no slope.
vec3 back_normal(ivec2 pixel, float depth) {
  int apart = max(int(0.7 * u_radius * pixels_per_meter(depth)), 1);
  pixel = clamp(pixel, ivec2(apart), max(ivec2(u_size.xy) - 1 - apart, ivec2(apart)));
  vec3 right = back_at(pixel + ivec2(apart, 0), depth) - back_at(pixel - ivec2(apart, 0), depth);
  vec3 up = back_at(pixel + ivec2(0, apart), depth) - back_at(pixel - ivec2(0, apart), depth);
  float most = 2.0 * right.x;
  right.z = clamp(right.z, -most, most);
  up.z = clamp(up.z, -most, most);
  return normalize(cross(right, up) + vec3(0.0, 0.0, 1e-9 * u_radius * u_radius));
}

// How far before the far side of the fluid a point is [m].
float before_back(vec3 point) {
  return point.z - back_at(ivec2(floor(pixel_of(point))), -point.z).z;
}

// How far a ray from a point goes to the first far side that it meets, `most` where it is still
// before one there. The far side that is seen straight on may be another one's; beyond the outline
// the ray has left the fluid by a side.
// @param deep  how far before the far side it begins, more than 0 [m]
float way_to_back(vec3 p, vec3 into, float most, float deep) {
  float at_most = before_back(p + most * into);
  if (at_most > 0.0) return most;
  Bracket back = Bracket(0.0, 0.0, deep, deep);
  for (int k = 1; k <= BACK_STEPS && back.at_to > 0.0; ++k) {
    float to = most * float(k) / float(BACK_STEPS);
    back = Bracket(back.to, to, back.at_to, k < BACK_STEPS ? before_back(p + to * into) : at_most);
  }
  for (int k = 0; k < 3; ++k) back = halved(back, before_back(p + middle(back) * into));
  return crossing(back);
}

// Out of the fluid through a surface whose normal is against the ray. Where it comes too flat for
// that, what the surface mirrors is not known: it leaves along the surface, as do rays just steep
// enough.
vec3 out_of(vec3 direction, vec3 n) {
  float c = clamp(-dot(direction, n), 0.0, 1.0);
  vec3 along = u_refractive_index * (direction + c * n);
  along *= 0.99 / max(length(along), 0.99);
  return along - sqrt(1.0 - dot(along, along)) * n;
}

// The way through a drop [m].
float chord_of_drop(vec3 view, vec3 n) {
  return 2.0 * u_drop_radius * clamp(-dot(view, n), 0.0, 1.0);
}

// The ray from a point of the surface (eye space) to what is seen through the fluid.
// @param body  0 for a drop, 1 in a body of fluid
Ray refracted(vec3 p, vec3 view, vec3 n, float thickness, float body) {
  float eta = 1.0 / u_refractive_index;
  vec3 into = refract(view, n, eta);
  vec3 once = to_world(into);
  vec3 position = u_eye + to_world(p);
  vec3 outward;
  float to_end = min(distance_to_ground(position, once), distance_to_wall(position, once, outward));
  Ray bound = Ray(position, once, 0.0, once);
  follow_to_wall_or_floor(bound);
  float deep = -back_at(ivec2(gl_FragCoord.xy), -p.z).z + p.z;
  float straight = max(deep, 0.0) / -view.z;
  float least = LEAST_WAY * u_radius;
  float most = FARTHEST * straight + 0.5 * u_radius;
  float way = way_to_back(p, into, clamp(to_end - 0.5 * u_radius, 0.0, most), max(deep, least));
  ivec2 at = ivec2(floor(pixel_of(p + way * into)));
  vec3 through = to_world(out_of(into, back_normal(at, way - p.z)));
  // Fluid that reaches up to wall or floor has no far side of its own.
  float gap = to_end - way;
  float is_bound = 1.0 - smoothstep(0.5 * u_radius, 3.0 * u_radius, gap);
  // A drop's far side bends the ray once more by as much as the near one. So does a sheet, behind
  // which there is air before there is more.
  vec3 twice = to_world(refract(view, n, eta * eta));
  float filled = filling(thickness, straight, to_end);
  float solid = body * smoothstep(0.55, 0.9, filled);
  // Beside an outline smoothing has taken away as much as a sprite's radius of fluid.
  float full = filling(thickness + u_radius, straight, to_end);
  is_bound *= step(1.0, body) * smoothstep(0.55, 0.9, full);
  solid = max(solid, is_bound);
  float longer = min(way / max(straight, least), FARTHEST);
  float length = mix(thickness, longer * thickness, solid);
  // Beyond a mirroring wall fluid goes on as far as it is sure to fill what is before the wall.
  float to_bound = min(to_end, bound.way);
  float goes_on = smoothstep(0.45, 0.7, filled);
  float bound_length = to_bound * min(full, 1.0) + (bound.way - to_bound) * goes_on;
  float leaves = mix(chord_of_drop(view, n), way, body);
  return Ray(mix(position + leaves * once, bound.at, is_bound),
             normalize(mix(mix(twice, through, solid), bound.direction, is_bound)),
             mix(length, bound_length, is_bound),
             normalize(mix(twice, once, solid)));
}
