#include "pbf/render/passes/spheres.hpp"

#include "pbf/render/nearest.hpp"
#include "pbf/render/passes/sphere_depth.hpp"

#include <algorithm>
#include <cmath>

namespace pbf {
namespace {

/// Less than Mesa's software driver can draw, which is 255 pixels; the graphics card that draws
/// less has not been built.
constexpr Real kLargestPoint = 200;

}  // namespace

void ColoredParticles::upload(const PointsView& positions,
                              const Colors& colors,
                              Real radius,
                              const Vec3& eye,
                              const FrameBlock& frame) {
  const Index n = positions.cols();
  // Off the axis the outline of a sphere is longer, by up to 1 / cos².
  const bool perspective = frame.size[2] > 0.5F;
  const Real scale = perspective ? 1 / nearest_front(positions, radius, frame, 0) : 1;
  const Real stretch =
      perspective ? 1 + frame.lens[0] * frame.lens[0] + frame.lens[1] * frame.lens[1] : 1;
  as_points_ = 2 * radius * frame.size[3] * scale * stretch < kLargestPoint;
  // Sorted by shells around the eye: the order within one is that in which they came.
  constexpr int kShells = 4096;
  Real farthest2 = 0;
  for (Index i = 0; i < n; ++i) {
    farthest2 = std::max(farthest2, (positions.col(i) - eye).squaredNorm());
  }
  const Real shells = (kShells - 1) / std::max(std::sqrt(farthest2), 1e-30F);
  std::vector<std::uint32_t> shell(static_cast<std::size_t>(n));
  std::vector<std::uint32_t> begin(kShells + 1, 0);
  for (Index i = 0; i < n; ++i) {
    // The last shell takes what is too far away for its distance to be a number.
    const auto k = static_cast<std::uint32_t>(
        std::min(static_cast<Real>(kShells - 1), shells * (positions.col(i) - eye).norm()));
    shell[static_cast<std::size_t>(i)] = k;
    ++begin[k + 1];
  }
  for (int k = 0; k < kShells; ++k) begin[k + 1] += begin[k];
  sorted_.resize(n);
  for (Index i = 0; i < n; ++i) {
    const Vec3 x = positions.col(i);
    const auto row = static_cast<std::size_t>(i);
    sorted_[static_cast<Index>(begin[shell[row]]++)] = {x.x(), x.y(), x.z(),
                                                        packed_color(colors[row])};
  }
  count_ = static_cast<GLsizei>(n);
  buffer_.upload(sorted_.data(), count_ * static_cast<GLsizeiptr>(sizeof(Record)));
}

void ColoredParticles::draw(Blend blend) const {
  set_draw_state(blend);
  (as_points_ ? points_ : quads_).bind();
  if (count_ == 0) return;
  if (as_points_) {
    glEnable(GL_PROGRAM_POINT_SIZE);
    glDrawArrays(GL_POINTS, 0, count_);
  } else {
    glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, count_);
  }
}

const Program& ColoredParticles::choose(ProgramVariants& programs,
                                        std::vector<std::string> defines) const {
  if (as_points_) defines.emplace_back("POINTS");
  return programs.with(defines);
}

Spheres::Spheres(const GlslSource& source)
    : program_(source,
               {.vertex = {"frame.glsl", "sphere_outline.glsl", "spheres.vert"},
                .fragment = {"frame.glsl", "sphere_hit.glsl", "spheres.frag"},
                .defines = {}}) {
  (void)program_.with({"POINTS"});  // an error in a shader shows now
}

void Spheres::operator()(const ColoredParticles& particles, Real radius, const Framebuffer& out) {
  out.clear(0, {kNothing, 0, 0, 0});
  out.clear(1, {0, 0, 0, 0});
  out.clear_depth();
  const Program& program = particles.choose(program_, {});
  program.use();
  program.set("u_radius", radius);
  program.set("u_target_size",
              Vec3(static_cast<Real>(out.width()), static_cast<Real>(out.height()), 0));
  particles.draw(Blend::nearest);
}

}  // namespace pbf
