// tint.frag: in: sphere with a color, affine depth of the surface. Out: weight times color (linear)
// and weight, for ADD blending. What is at the surface counts, and what is a radius behind it a
// third of that; what is farther in front of it is a drop that ends before the texel, for here
// spheres are as large as a body's. The color seen is that of the fluid that is seen.
uniform sampler2D u_depth;
uniform vec3 u_target_size;  // [pixels]
flat in vec4 v_sphere;  // center in eye space and radius [m]
flat in vec3 v_color;    // linear
layout(location = 0) out vec4 o_tint;

void main() {
  // The target is coarser than the picture: the front of the pixels around counts.
  vec2 at = gl_FragCoord.xy * u_size.xy / u_target_size.xy;
  ivec2 last = ivec2(u_size.xy) - 1;
  ivec2 low = min(ivec2(at - 0.5), last);
  ivec2 high = min(low + 1, last);
  float a = max(max(texelFetch(u_depth, low, 0).r, texelFetch(u_depth, high, 0).r),
                max(texelFetch(u_depth, ivec2(low.x, high.y), 0).r,
                    texelFetch(u_depth, ivec2(high.x, low.y), 0).r));
  Hit hit = hit_sphere(at, v_sphere.xyz, v_sphere.w);
  float behind = is_surface(a) ? (hit.front - depth_of(a)) / v_sphere.w : NOWHERE;
  float near = smoothstep(-1.25, -0.75, behind);
  float weight = max(hit.chord, 0.0) / v_sphere.w * near * exp(-max(behind, 0.0));
  o_tint = vec4(weight * v_color, weight);
}
