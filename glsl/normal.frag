// normal.frag: in: smoothed affine depth, and that of the spheres with their crowding. Out: unit
// normal in eye space, towards the viewer; 0 without fluid.
uniform sampler2D u_values;
uniform sampler2D u_spheres;
uniform float u_range;        // a step of depth that is higher is between two surfaces [m]
uniform float u_radius;       // of a sphere in a body of fluid [m]
uniform float u_drop_radius;  // of one alone [m]
layout(location = 0) out vec4 o_normal;

const float MOST_REACH = 64.0;  // of a ring [pixels]
// From the pixel to the middle of its neighbors at an outline, in the ring's radius: with this the
// normals of balls are nearest to the true ones (docs/smoothing.md).
const float MIDDLE_AT_OUTLINE = 0.57;

vec3 position(ivec2 pixel, out bool exists) {
  bool inside = all(greaterThanEqual(pixel, ivec2(0))) && all(lessThan(pixel, ivec2(u_size.xy)));
  float a = texelFetch(u_values, clamp(pixel, ivec2(0), ivec2(u_size.xy) - 1), 0).r;
  exists = inside && is_surface(a);
  return eye_position(vec2(pixel) + 0.5, depth_of(exists ? a : affine_depth(1.0)));
}

// The surface along an axis of the picture.
struct Tangent {
  vec3 along;  // towards the next pixel
  vec3 step;   // from the pixel to the neighbor of the smaller step of depth
  bool ends;   // there is no surface on one of the sides, or only another one
  bool lone;   // on neither
};

// From differences of positions to both sides, each weighted by 1/(1 + (dz/pixel)^2)^2. Both are
// tangent to a plane, so the normal of a plane is exact; on a gentle slope they count the same,
// which is the central difference; at a silhouette the smaller step wins.
// A strand or a groove of a single pixel faces the viewer: the smaller of its two steps is no slope
// of its own, and would be a speck that mirrors everything.
// @param reach  a step of depth that is higher leads to another sphere [m]
Tangent tangent(ivec2 pixel, ivec2 axis, vec3 p, float width, float reach) {
  bool has_next, has_previous;
  vec3 next = position(pixel + axis, has_next) - p;
  vec3 previous = p - position(pixel - axis, has_previous);
  float floor2 = width * width;
  float w_next = has_next ? floor2 / (next.z * next.z + floor2) : 0.0;
  float w_previous = has_previous ? floor2 / (previous.z * previous.z + floor2) : 0.0;
  bool strand = has_next == has_previous && next.z * previous.z <= 0.0 &&
                min(abs(next.z), abs(previous.z)) > u_range;
  bool on_next = has_next && abs(next.z) < reach;
  bool on_previous = has_previous && abs(previous.z) < reach;
  vec3 sum = w_next * w_next * next + w_previous * w_previous * previous;
  bool faces = strand || (!has_next && !has_previous);
  return Tangent(faces ? vec3(axis, 0.0) : sum, w_next > w_previous ? next : -previous,
                 !(on_next && on_previous), !(on_next || on_previous));
}

// Normal of the sphere of radius 1 through a point and two more, at steps a and b from it: their
// circle's center lies at c, the sphere's behind it as seen along `view`. 0 if there is none.
vec3 sphere_normal(vec3 a, vec3 b, vec3 view) {
  vec3 across = cross(a, b);
  vec3 c = cross(dot(a, a) * b - dot(b, b) * a, across) / (2.0 * dot(across, across));
  float height2 = 1.0 - dot(c, c);
  vec3 n = -sign(dot(across, view)) * normalize(across);
  return height2 > 0.0 ? sqrt(height2) * n - c : vec3(0.0);
}

// What eight neighbors around and the pixel say, weighted as the bilateral filter does.
struct Ring {
  float count, rise;  // sums of weights, and of weights times differences of affine depth
  vec2 sum, slope;    // those of weight times distance [pixels], and times difference
  vec3 spread;        // of weight times distance times distance: xx, xy, yy
  vec2 gone;          // of distances to where there is nothing, or only what is farther away
};

// @param down, up  1 / how much less or more affine depth is another surface's
void add(inout Ring ring, ivec2 pixel, ivec2 offset, float a, float down, float up) {
  ivec2 at = clamp(pixel + offset, ivec2(0), ivec2(u_size.xy) - 1);
  float difference = texelFetch(u_values, at, 0).r - a;
  float u = max(difference * up, -difference * down);
  float u2 = u * u;
  float keep = max(1.0 - u2, 0.0);
  float weight = keep * keep;
  vec2 x = vec2(at - pixel);
  vec2 weighted = weight * x;
  ring.count += weight;
  ring.rise += weight * difference;
  ring.sum += weighted;
  ring.slope += difference * weighted;
  ring.spread += weighted.xxy * x.xyy;
  ring.gone += difference < 0.0 ? min(u2 * u2, 1.0) * x : vec2(0.0);
}

// The normal where a body of fluid ends within a sprite's radius. The filter knows one side only
// there, and what it makes of the spheres' outlines is rough; the plane that fits the neighbors
// best is not. It is that of their middle. From there to the outline the body curls away until the
// view grazes it: as on a sphere, the square of the cosine between view and normal falls in
// proportion to the distance from the outline.
// @param n      by differences
// @param reach  a sprite's radius [pixels]
vec3 rim_normal(ivec2 pixel, vec3 p, vec3 n, int reach) {
  float a = texelFetch(u_values, pixel, 0).r;
  float down = 1.0 / farther(a, u_range), up = 1.0 / nearer(a, u_range);
  Ring ring = Ring(1.0, 0.0, vec2(0.0), vec2(0.0), vec3(0.0), vec2(0.0));
  ivec2 straight = ivec2(reach, 0), diagonal = ivec2((7 * reach + 5) / 10);
  for (int k = 0; k < 4; ++k) {
    add(ring, pixel, straight, a, down, up);
    add(ring, pixel, diagonal, a, down, up);
    straight = ivec2(-straight.y, straight.x);
    diagonal = ivec2(-diagonal.y, diagonal.x);
  }
  vec2 middle = ring.sum / ring.count;
  vec3 spread = ring.spread - ring.sum.xxy * middle.xyy;
  vec2 slope = ring.slope - ring.rise * middle;
  float determinant = spread.x * spread.z - spread.y * spread.y;
  float gone = length(ring.gone);
  // Neighbors nearly in a line do not tell a plane.
  float radius2 = float(reach * reach);
  float known = smoothstep(0.05, 0.3, determinant / (radius2 * radius2));
  if (known == 0.0 || gone == 0.0) return n;
  vec2 rise = (spread.zx * slope - spread.y * slope.yx) / determinant;  // to the next pixels
  vec2 at = gl_FragCoord.xy;
  vec3 right = eye_position(at + vec2(1.0, 0.0), depth_of(a + rise.x)) - p;
  vec3 above = eye_position(at + vec2(0.0, 1.0), depth_of(a + rise.y)) - p;
  vec3 plane = normalize(cross(right / u_radius, above / u_radius));
  vec3 view = normalize(ray_direction(at));
  float cosine = clamp(-dot(plane, view), 0.0, 1.0);
  vec3 across = plane + cosine * view;
  across /= max(length(across), 1e-6);  // a plane that faces the viewer tilts nowhere
  float inwards = max(-dot(middle, ring.gone) / gone, 0.0) / float(reach);
  float to_outline = max(1.0 - inwards / MIDDLE_AT_OUTLINE, 0.5 / float(reach));
  cosine *= sqrt(to_outline / (to_outline + inwards));
  vec3 own = sqrt(1.0 - cosine * cosine) * across - cosine * view;
  return normalize(mix(n, own, known * min(gone / float(reach), 1.0)));
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  bool exists;
  vec3 p = position(pixel, exists);
  o_normal = vec4(0.0);
  if (!exists) return;
  float width = 1.0 / pixels_per_meter(-p.z);  // of a pixel [m]
  float sphere = texelFetch(u_spheres, pixel, 0).r;
  float radius = mix(u_drop_radius, u_radius, crowding_of(sphere));
  Tangent x = tangent(pixel, ivec2(1, 0), p, width, radius);
  Tangent y = tangent(pixel, ivec2(0, 1), p, width, radius);
  vec3 n = normalize(cross(normalize(x.along), normalize(y.along)));
  // At the outline of a drop a difference to one side is that of half a pixel farther in, where it
  // is less steep. The drop is a sphere.
  if (!is_body(sphere) && (x.ends || y.ends) && !x.lone && !y.lone) {
    vec3 view = ray_direction(gl_FragCoord.xy);
    vec3 own = sphere_normal(x.step / radius, y.step / radius, view);
    n = dot(own, view) < 0.0 ? own : n;
  }
  int reach = int(min(u_radius / width, MOST_REACH));
  // Where nobody tells drops from bodies, every sphere may be alone.
  bool has_drops = u_drop_radius < u_radius;
  if (has_drops && is_body(sphere) && reach > 1) n = rim_normal(pixel, p, n, reach);
  o_normal = vec4(n, 0.0);
}
