// sprite_hit.glsl: where a pixel's viewing ray passes through what sprite.vert draws.
flat in vec4 v_sphere;  // center in eye space and radius [m]
#ifdef ELLIPSOIDS
flat in mat3 v_to_sphere;

Hit hit_sprite(vec2 pixel) { return hit_ellipsoid(pixel, v_sphere.xyz, v_sphere.w, v_to_sphere); }
#else
Hit hit_sprite(vec2 pixel) { return hit_sphere(pixel, v_sphere.xyz, v_sphere.w); }
#endif
