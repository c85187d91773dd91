#include "pbf/render/passes/opaque_meshes.hpp"

#include "pbf/gl/draw.hpp"
#include "pbf/render/passes/sphere_depth.hpp"

namespace pbf {

MeshTargets::MeshTargets(const Texture& color)
    : light(color.width(), color.height(), Format::rgba16f),
      depth(color.width(), color.height(), Format::r32f),
      nearest(color.width(), color.height(), Format::depth32f),
      framebuffer({&color, &light, &depth, &nearest}) {}

OpaqueMeshes::OpaqueMeshes(GlslSource source)
    : program_(
          std::move(source),
          {.vertex = {"frame.glsl", "opaque_meshes.vert"},
           .fragment = {"frame.glsl", "environment.glsl", "display.glsl", "opaque_meshes.frag"},
           .defines = {}}),
      buffer_(GL_ARRAY_BUFFER) {
  array_.vertices(buffer_, 3, 0);
}

void OpaqueMeshes::operator()(const Meshes& meshes,
                              const Surroundings& surroundings,
                              const Camera& camera,
                              const RenderParams& params,
                              const MeshTargets& to) {
  to.framebuffer.clear(1, {0, 0, 0, 0});
  to.framebuffer.clear(2, {kNothing, 0, 0, 0});
  to.framebuffer.clear_depth();
  const Environment environment = environment_of(params, camera);
  const Program& program = program_.with(environment_defines(environment, false));
  program.use();
  set_environment(program, surroundings, environment);
  set_draw_state(Blend::nearest);
  std::vector<float> corners;
  for (const auto& mesh : meshes) {
    corners.clear();
    corners.reserve(9 * mesh->triangles().size());
    for (const Mesh::Triangle& triangle : mesh->triangles()) {
      for (const std::int64_t vertex : triangle) {
        const float* at = mesh->vertices().col(vertex).data();
        corners.insert(corners.end(), at, at + 3);
      }
    }
    if (corners.empty()) continue;
    buffer_.upload(corners.data(), static_cast<GLsizeiptr>(corners.size() * sizeof(float)));
    program.set("u_color", mesh->color());
    array_.bind();
    glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(corners.size() / 3));
  }
}

}  // namespace pbf
