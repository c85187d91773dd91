// composite.frag: in: smoothed affine depth of front and back, smoothed thickness [m], normal (eye
// space). Out: the fluid, linear, multiplied by alpha, to be blended over what is behind.
uniform sampler2D u_depth;
uniform sampler2D u_thickness;
uniform sampler2D u_back;          // smoothed affine depth of the far side
uniform sampler2D u_normal;
#ifdef MESHES
uniform sampler2D u_mesh_light;    // linear
uniform sampler2D u_mesh_depth;    // affine
#endif
uniform vec3 u_absorption;         // [1/m]
uniform vec3 u_scatter;            // color of deep fluid
uniform float u_refractive_index;
uniform float u_radius;            // of a sprite [m]
uniform float u_sprite_thickness;  // mean thickness of a single sprite [m]
uniform float u_drop_radius;       // of a lone sprite [m]
uniform sampler2D u_spheres;       // affine depth with crowding
uniform sampler2D u_tint;          // weight times color and weight (tint.frag)
uniform int u_has_tint;            // 1: the fluid has its particles' colors
layout(location = 0) out vec4 o_color;

const float SPREAD = 3.0;       // of rays from a body's surface, in that of a pixel
const float LEAST_WAY = 1e-4;   // in the fluid; shorter ones count as this [sprites' radii]
const int MESH_STEPS = 24;      // of a ray that looks for a mesh
const int EXIT_STEPS = 6;       // of one that looks for its way out of the fluid
const float FARTHEST = 1.5;     // a bent ray's way to the far side, in that of the straight one
const int BACK_STEPS = 6;       // of one that looks for the far side
const int BOUNCES = 3;          // of a ray in a tank: as many as a corner has walls

// Share of unpolarized light that a smooth dielectric mirrors (Fresnel); c is the cosine of
// incidence.
float fresnel(float c, float index) {
  float g2 = index * index - 1.0 + c * c;
  float g = sqrt(max(g2, 1e-6));
  float a = (g - c) / (g + c);
  float b = (c * (g + c) - 1.0) / (c * (g - c) + 1.0);
  return 0.5 * a * a * (1.0 + b * b);
}

// Beer-Lambert: what is left of light after a way through the fluid.
vec3 transmittance(float way) { return exp(-u_absorption * way); }

// Fluid that stands on the floor does not curl in below it, as its lowest spheres do.
vec3 upright_at_floor(vec3 n, vec3 position) {
  vec3 up = mat3(u_view) * u_up;
  float height = u_has_floor == 1 ? height_above_floor(position) / u_radius : NOWHERE;
  float nearness = 1.0 - smoothstep(1.0, 3.0, height);
  return normalize(n - nearness * min(dot(n, up), 0.0) * up);
}

float tank_bottom() { return min(dot(u_tank_lower, u_up), dot(u_tank_upper, u_up)); }

// Whether there is air below the tank, as beyond its walls.
bool bottom_is_wall() {
  return u_has_floor == 0 || tank_bottom() > u_floor_height + 0.5 * u_radius;
}

// How far it is to the tank's wall from inside. A bottom on the floor and the surface are none.
float distance_to_wall(vec3 point, vec3 direction, out vec3 outward) {
  vec3 side = mix(vec3(-1.0), vec3(1.0), step(0.0, direction));
  vec3 face = mix(u_tank_lower, u_tank_upper, step(0.0, direction));
  vec3 way = (face - clamp(point, u_tank_lower, u_tank_upper)) / (side * max(abs(direction), 1e-6));
  bool goes_down = bottom_is_wall() && dot(direction, u_up) < 0.0;
  way += goes_down ? vec3(0.0) : NOWHERE * step(0.9, abs(u_up));
  float nearest = min(way.x, min(way.y, way.z));
  outward = side * vec3(lessThanEqual(way, vec3(nearest)));
  return u_has_tank == 1 ? nearest : NOWHERE;
}

// How far it is to the floor or the tank's bottom that stands on it.
float distance_to_ground(vec3 point, vec3 direction) {
  float down = -dot(direction, u_up);
  bool ends = u_has_tank == 1 && !bottom_is_wall() && down > 1e-4;
  float to_bottom = ends ? max(dot(point, u_up) - tank_bottom(), 0.0) / down : NOWHERE;
  return min(to_bottom, distance_to_floor(point, direction));
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

// How far a ray goes through the fluid before it leaves it, as far as the picture knows: steps
// that grow until one leads out, whose ends are brought together.
float way_inside(Ray ray, float most) {
  float from = 0.0, to = 0.0;
  float at_from = 1.0, at_to = 1.0;
  for (int k = 1; k <= EXIT_STEPS && at_to > 0.0; ++k) {
    from = to;
    at_from = at_to;
    to = most * float(k * k) / float(EXIT_STEPS * EXIT_STEPS);
    at_to = inside_fluid(ray, to);
  }
  if (at_to > 0.0) return most;
  for (int k = 0; k < 4; ++k) {
    float middle = 0.5 * (from + to);
    float at_middle = inside_fluid(ray, middle);
    bool is_in = at_middle > 0.0;
    from = is_in ? middle : from;
    at_from = is_in ? at_middle : at_from;
    to = is_in ? to : middle;
    at_to = is_in ? at_to : at_middle;
  }
  return mix(from, to, at_from / (at_from - at_to));
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
float way_to_back(vec3 p, vec3 into, float most) {
  float at_most = before_back(p + most * into);
  if (at_most > 0.0) return most;
  float from = 0.0, to = 0.0;
  float at_from = 1.0, at_to = 1.0;
  for (int k = 1; k <= BACK_STEPS && at_to > 0.0; ++k) {
    from = to;
    at_from = at_to;
    to = most * float(k) / float(BACK_STEPS);
    at_to = k < BACK_STEPS ? before_back(p + to * into) : at_most;
  }
  for (int k = 0; k < 3; ++k) {
    float middle = 0.5 * (from + to);
    float at_middle = before_back(p + middle * into);
    bool is_in = at_middle > 0.0;
    from = is_in ? middle : from;
    at_from = is_in ? at_middle : at_from;
    to = is_in ? to : middle;
    at_to = is_in ? at_to : at_middle;
  }
  return mix(from, to, at_from / (at_from - at_to));
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
  float most = FARTHEST * straight + 0.5 * u_radius;
  float way = way_to_back(p, into, clamp(to_end - 0.5 * u_radius, 0.0, most));
  ivec2 at = ivec2(floor(pixel_of(p + way * into)));
  vec3 through = to_world(out_of(into, back_normal(at, way - p.z)));
  // Fluid that reaches up to wall or floor has no far side of its own.
  float gap = to_end - way;
  float is_bound = 1.0 - smoothstep(0.5 * u_radius, 3.0 * u_radius, gap);
  // A drop's far side bends the ray once more by as much as the near one. So does a sheet, behind
  // which there is air before there is more.
  vec3 twice = to_world(refract(view, n, eta * eta));
  float least = LEAST_WAY * u_radius;
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

#ifdef MESHES
// Where a point of a ray lies in the picture of the meshes.
struct MeshPoint {
  float depth;  // of the mesh there, NOWHERE without one [m]
  vec3 light;
};
MeshPoint mesh_at(vec3 point) {
  ivec2 pixel = ivec2(clamp(pixel_of(point), vec2(0.0), u_size.xy - 1.0));
  float a = texelFetch(u_mesh_depth, pixel, 0).r;
  return MeshPoint(is_surface(a) ? depth_of(a) : NOWHERE,
                   texelFetch(u_mesh_light, pixel, 0).rgb);
}

// Where a ray from a point in eye space meets a mesh, as far as the picture knows: with the first
// step that leads behind one, and not far behind; then twice nearer. What stands far before the ray
// only hides what the ray may meet: the mesh beside it goes on behind it.
bool meets_mesh(vec3 p, vec3 direction, float farthest, out float way, out vec3 light) {
  float span = farthest / float(MESH_STEPS);
  float ahead = max(-direction.z, 0.01);
  float thick = 2.0 * span * ahead;
  bool meets = false;
  MeshPoint last = MeshPoint(NOWHERE, vec3(0.0));
  way = 0.0;
  for (int k = 0; k < MESH_STEPS && !meets; ++k) {
    way += span;
    vec3 point = p + way * direction;
    MeshPoint mesh = mesh_at(point);
    bool hides = mesh.depth <= -p.z || mesh.depth <= -point.z - thick;
    if (!hides) last = mesh;
    meets = last.depth <= -point.z && last.depth > -point.z - thick;
  }
  light = last.light;
  for (int k = 0; k < 2; ++k) {
    vec3 point = p + way * direction;
    MeshPoint mesh = mesh_at(point);
    float behind = -point.z - mesh.depth;
    bool is_nearer = abs(behind) < thick && mesh.depth > -p.z;
    light = is_nearer ? mesh.light : light;
    way -= is_nearer ? behind / ahead : 0.0;
  }
  return meets;
}
#endif

// Color of the fluid itself: its own, or by its particles' values. Sums are interpolated, not
// colors: texels without fluid have no weight.
vec3 body_color() {
  if (u_has_tint == 0) return u_scatter;
  vec2 at = gl_FragCoord.xy * vec2(textureSize(u_tint, 0)) / u_size.xy - 0.5;
  ivec2 last = textureSize(u_tint, 0) - 1;
  ivec2 low = max(ivec2(floor(at)), 0);
  ivec2 high = min(low + 1, last);
  vec2 share = clamp(at - vec2(low), 0.0, 1.0);
  vec4 left = mix(texelFetch(u_tint, low, 0), texelFetch(u_tint, ivec2(low.x, high.y), 0), share.y);
  vec4 right = mix(texelFetch(u_tint, ivec2(high.x, low.y), 0),
                   texelFetch(u_tint, high, 0), share.y);
  vec4 sums = mix(left, right, share.x);
  return sums.rgb / max(sums.a, 1e-20);
}

// Light from the surface, and how much of that of a transparent background comes through.
struct Shade {
  vec3 light;
  vec3 clear;
};

// The surface that a drop hides: the mean of four normals around the drop, 0 where no fluid is
// farther away. The less of them there are, the less is known of what the drop hides.
vec3 normal_behind(ivec2 pixel, float depth) {
  vec3 sum = vec3(0.0);
  int away = int(2.5 * u_drop_radius * pixels_per_meter(depth)) + 2;
  for (int k = 0; k < 4; ++k) {
    int side = (k & 1) == 0 ? away : -away;
    ivec2 at = pixel + (k < 2 ? ivec2(side, 0) : ivec2(0, side));
    at = clamp(at, ivec2(0), ivec2(u_size.xy) - 1);
    float a = texelFetch(u_depth, at, 0).r;
    bool farther = is_surface(a) && depth_of(a) > depth + 2.0 * u_drop_radius;
    sum += farther ? texelFetch(u_normal, at, 0).xyz : vec3(0.0);
  }
  return 0.25 * sum;
}

// What the surface behind a drop adds to the drop: as far as the drop lets light through it
// mirrors, and below it the ray goes on more steeply.
struct Behind {
  vec3 mirrored;   // share of its light that the surface mirrors
  vec3 direction;  // where that comes from
  float way;       // through the fluid behind, over that straight on
  float meets;     // how far what the drop mirrors is that surface, and not what is beyond
};

Behind behind_drop(vec3 view, vec3 n, vec3 hidden, float body) {
  float known2 = dot(hidden, hidden);
  float share = (1.0 - body) * known2;
  vec3 normal = hidden / sqrt(max(known2, 1e-12));
  float c = clamp(-dot(view, normal), 0.0, 1.0);
  float bent = sqrt(1.0 - (1.0 - c * c) / (u_refractive_index * u_refractive_index));
  return Behind(share * fresnel(c, u_refractive_index) * transmittance(chord_of_drop(view, n)),
                reflect(view, normal), mix(1.0, c / max(bent, 1e-6), share),
                body < 1.0 ? known2 * smoothstep(0.0, 0.3, -dot(reflect(view, n), normal)) : 0.0);
}

// How far rays that are a pixel apart are from one another [pixels] where the surface has mirrored
// them: twice as far as its normals turn from pixel to pixel. Across an edge the side that turns
// less is the surface's own.
float mirrored_spread(ivec2 pixel) {
  ivec2 last = ivec2(u_size.xy) - 1;
  vec3 n = texelFetch(u_normal, pixel, 0).xyz;
  float turn2 = 0.0;
  for (int k = 0; k < 2; ++k) {
    ivec2 axis = k == 0 ? ivec2(1, 0) : ivec2(0, 1);
    vec3 next = texelFetch(u_normal, min(pixel + axis, last), 0).xyz - n;
    vec3 previous = texelFetch(u_normal, max(pixel - axis, 0), 0).xyz - n;
    turn2 += min(dot(next, next), dot(previous, previous));
  }
  return 2.0 * sqrt(0.5 * turn2) * pixels_per_radian();
}

// @param to_mesh  length of the straight way to a mesh [m]
// @param body     0 for a drop, 1 in a body of fluid
// @param hidden   normal of the surface that a drop hides
Shade fluid(vec3 p, vec3 view, vec3 n, float thickness, float to_mesh, float body, vec3 hidden) {
  vec3 position = u_eye + to_world(p);
  n = upright_at_floor(n, position);
  float mirrored = fresnel(clamp(-dot(view, n), 0.0, 1.0), u_refractive_index);
  // Colors that mean something are not to drown in the sky's reflection.
  mirrored *= u_has_tint == 1 ? 0.3 : 1.0;
  vec3 mirror = to_world(reflect(view, n));
  // A drop turns rays that are a pixel apart by a pixel's share of its radius.
  float of_drop = pixels_per_radian() / (u_drop_radius * pixels_per_meter(-p.z));
  float spread = mix(max(of_drop, SPREAD), SPREAD, body);
  float wide = max(spread, mirrored_spread(ivec2(gl_FragCoord.xy)));
  vec3 reflection = environment(MIRRORED(mirror, wide), position, mirror, -p.z, wide).rgb;
  Ray ray = refracted(p, view, n, thickness, body);
  vec4 behind = environment(BACKDROP(ray.direction, spread), ray.at, ray.direction, -p.z, spread);
#ifdef MESHES
  vec3 light;
  float way;
  float farthest = 1.3 * max(ray.way, is_met(to_mesh) ? to_mesh : 0.0);
  if (meets_mesh(p, mat3(u_view) * ray.first, farthest, way, light)) {
    behind = vec4(light, 1.0);
    ray.way = min(ray.way, way);
  }
#endif
  Behind also = behind_drop(view, n, hidden, body);
  float own = min(chord_of_drop(view, n), ray.way);
  ray.way = own + (ray.way - own) * also.way;
  vec3 left = transmittance(ray.way);
  vec3 up_facing = to_world(n);
  float lit = 0.60 + 0.25 * dot(up_facing, u_up) + 0.35 * dot(up_facing, u_sun);
  vec3 through = behind.rgb * left + body_color() * lit * (1.0 - left);
  through = mix(through, MIRRORED(to_world(also.direction), SPREAD).rgb, also.mirrored);
  // At its rim a drop mirrors what it hides: the same as is seen through it.
  mirrored *= 1.0 - also.meets;
  vec3 clear = (1.0 - mirrored) * (1.0 - also.mirrored) * (1.0 - behind.a) * left;
  return Shade(mix(through, reflection, mirrored), clear);
}

// Share of the 3x3 pixels around that hold fluid: softens the outline.
float coverage(ivec2 pixel) {
  float sum = 0.0;
  ivec2 last = ivec2(u_size.xy) - 1;
  for (int y = -1; y <= 1; ++y) {
    for (int x = -1; x <= 1; ++x) {
      float weight = float((2 - abs(x)) * (2 - abs(y)));
      ivec2 at = clamp(pixel + ivec2(x, y), ivec2(0), last);
      sum += is_surface(texelFetch(u_depth, at, 0).r) ? weight : 0.0;
    }
  }
  return sum / 16.0;
}

// A body's spheres stick out of the tank by less than their radius, but fluid ends at its walls.
// What a ray meets before a wall is moved there, and what it meets behind one is not there. Fluid
// farther outside stays where it is.
// @param back  length of the ray's way to the far side [m]
// @return      share of the pixel that is fluid
float cut_at_walls(inout vec3 p, vec3 view, float back, float body, inout vec3 n) {
  vec3 point = u_eye + to_world(p);
  vec3 direction = to_world(view);
  vec3 is_up = step(0.9, abs(u_up));
  bool goes_down = dot(direction, u_up) < 0.0;
  vec3 opens_near = goes_down || !bottom_is_wall() ? is_up : vec3(0.0);
  vec3 opens_far = goes_down && bottom_is_wall() ? vec3(0.0) : is_up;
  vec3 outside = (1.0 - is_up) * max(u_tank_lower - point, point - u_tank_upper);
  bool is_outside = max(outside.x, max(outside.y, outside.z)) > u_radius;
  if (u_has_tank == 0 || body < 1.0 || is_outside) return 1.0;
  vec3 ahead = step(0.0, direction);
  vec3 speed = mix(vec3(-1.0), vec3(1.0), ahead) * max(abs(direction), 1e-5);
  vec3 to_near = (mix(u_tank_upper, u_tank_lower, ahead) - point) / speed - NOWHERE * opens_near;
  vec3 to_far = (mix(u_tank_lower, u_tank_upper, ahead) - point) / speed + NOWHERE * opens_far;
  float enters = max(to_near.x, max(to_near.y, to_near.z));
  float leaves = min(to_far.x, min(to_far.y, to_far.z));
  // It stands at a wall as at the floor: up to the glass, without curling away from it. A surface
  // that faces the viewer through a near wall keeps its normal.
  vec3 world_n = to_world(n);
  float lies = smoothstep(0.4, 0.8, abs(dot(world_n, u_up)));
  vec3 far = (1.0 - smoothstep(2.0, 5.0, to_far * abs(speed) / u_radius)) * sign(speed);
  vec3 near = (1.0 - smoothstep(2.0, 5.0, -to_near * abs(speed) / u_radius)) * -sign(speed);
  vec3 flat_n = world_n - far * max(world_n * far, 0.0) - lies * near * max(world_n * near, 0.0);
  n = normalize(mat3(u_view) * (flat_n - 1e-6 * direction));
  // Filters round off the edge between two walls; one behind the viewer is not seen through.
  float inside = -enters * dot(abs(speed), vec3(greaterThanEqual(to_near, vec3(enters))));
  if (inside < (1.0 - lies) * u_radius && p.z + enters * view.z < 0.0) {
    p += enters * view;
    n = mat3(u_view) * (-sign(speed) * vec3(greaterThanEqual(to_near, vec3(enters))));
    leaves = min(leaves, back) - enters;
  }
  return clamp(0.5 + 0.5 * leaves * pixels_per_meter(-p.z), 0.0, 1.0);
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec3 view = normalize(ray_direction(gl_FragCoord.xy));
  float a = texelFetch(u_depth, pixel, 0).r;
  float share = is_surface(a) ? clamp(1.8 * coverage(pixel) - 0.55, 0.0, 1.0) : 0.0;
  vec3 p = eye_position(gl_FragCoord.xy, is_surface(a) ? depth_of(a) : 1.0);
  vec3 n = texelFetch(u_normal, pixel, 0).xyz;
  // What is crowded by two thirds is a body's edge, whatever rounding makes of it.
  float body = min(1.6 * crowding_of(texelFetch(u_spheres, pixel, 0).r), 1.0);
  share *= cut_at_walls(p, view, (p.z - back_at(pixel, -p.z).z) / -view.z, body, n);
  // The floor hides what sticks out below it.
  if (is_below_floor(u_eye + to_world(p))) share = 0.0;
  float thickness = texelFetch(u_thickness, pixel, 0).r;
  // Where a lone sprite thins out there is less than a particle: fading it takes the beads off the
  // outline.
  share *= smoothstep(0.1, 0.8, thickness / u_sprite_thickness);
  float to_mesh = NOWHERE;
#ifdef MESHES
  // Meshes hide the fluid behind them.
  float mesh = texelFetch(u_mesh_depth, pixel, 0).r;
  if (mesh > a) share = 0.0;
  if (is_surface(mesh)) to_mesh = max((depth_of(mesh) + p.z) / -view.z, 0.0);
#endif
  Shade shade = fluid(p, view, n, thickness, to_mesh, body, normal_behind(pixel, -p.z));
  // One alpha for three channels: that of the clearest would let the colors of others through, so
  // the least clear one has it, and the rest is what background_color adds to the others.
  float clear = min(shade.clear.r, min(shade.clear.g, shade.clear.b));
  vec3 light = shade.light + (shade.clear - clear) * u_background_color;
  o_color = share > 0.0 ? share * display(light, 1.0 - clear) : vec4(0.0);
}
