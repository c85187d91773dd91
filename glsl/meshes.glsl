// meshes.glsl: where a ray meets the meshes that the picture shows, where there are any.
#ifdef MESHES
uniform sampler2D u_mesh_light;  // linear
uniform sampler2D u_mesh_depth;  // affine

const int MESH_STEPS = 24;  // of a ray that looks for a mesh

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
