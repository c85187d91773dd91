#include "pbf/render/passes/spheres.hpp"

#include "gl_fixture.hpp"
#include <bit>
#include <cmath>

using namespace pbf;
using namespace pbf::test;

TEST_CASE("spheres: depth, normal and color are those of the nearest sphere, in any order") {
  const GlFixture gl;
  const Real radius = 0.4F;
  Points centers(3, 2);
  centers.col(0) = Vec3(0.1F, 0, -3);
  centers.col(1) = Vec3(-0.1F, 0.05F, -2.5F);
  const Texture depth(gl.width(), gl.height(), Format::r32f);
  const Texture surface(gl.width(), gl.height(), Format::rgba32f);
  const Texture nearest(gl.width(), gl.height(), Format::depth32f);
  const Framebuffer out({&depth, &surface, &nearest});
  Spheres pass(glsl_source);
  for (const bool turned : {false, true}) {
    const Points x = turned ? Points(centers.rowwise().reverse()) : centers;
    const Colors colors = turned ? Colors{0xFFFFFF, 0x000001} : Colors{0x000001, 0xFFFFFF};
    ColoredParticles particles;
    particles.upload(x, colors, radius, Vec3::Zero(), gl.frame());
    pass(particles, radius, out);
    const auto a = gl.read(depth);
    const auto normals = gl.read(surface, 3);
    std::vector<float> all(a.size() * 4);
    Framebuffer({&surface}).read(GL_RGBA, GL_FLOAT, all.data());
    int seen = 0;
    for (int row = 0; row < gl.height(); ++row) {
      for (int column = 0; column < gl.width(); ++column) {
        const Eigen::Vector3d ray(gl.slope_x(column), gl.slope_y(row), -1);
        double front = 1e9;
        int which = -1;
        bool at_edge = false;
        for (int k = 0; k < 2; ++k) {
          const Eigen::Vector3d center = centers.col(k).cast<double>();
          const double middle = ray.dot(center) / ray.squaredNorm();
          const double half2 = double(radius) * radius - (center - middle * ray).squaredNorm();
          at_edge |= std::abs(half2) < 1e-3;
          if (half2 <= 0) continue;
          const double d = middle - std::sqrt(half2 / ray.squaredNorm());
          if (d < front) which = k;
          front = std::min(front, d);
        }
        if (at_edge) continue;
        const std::size_t at = gl.at(column, row);
        if (which < 0) {
          CHECK(a[at] == kNothing);
          continue;
        }
        ++seen;
        CHECK(1 / a[at] == doctest::Approx(front).epsilon(2e-6));
        const Eigen::Vector3d expected = (front * ray - centers.col(which).cast<double>()) / radius;
        for (int k = 0; k < 3; ++k) {
          CHECK(std::abs(normals[3 * at + k] - expected[k]) < 1e-4);
        }
        const auto color = std::bit_cast<std::uint32_t>(all[4 * at + 3]);
        CHECK(color == (0x3F000000U | (which == 0 ? 0x000001U : 0xFFFFFFU)));
      }
    }
    CHECK(seen > 100);
  }
}
