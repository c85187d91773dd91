// One ellipsoid on and off the axis, drawn by the passes in C++ and by the shaders.
#include "pbf/render/passes/sphere_depth.hpp"
#include "pbf/render/raster/splats.hpp"

#include <Eigen/Geometry>

#include "drawn_splats.hpp"
#include "gl_fixture.hpp"
#include <cmath>

using namespace pbf;
using namespace pbf::test;

namespace {

constexpr int kWidth = 160, kHeight = 120;

struct Cloud {
  Records centers, stretches;
};

/// An ellipsoid of volume 1 and any axes, turned.
Cloud ellipsoid(const Vec3& center, const Vec3& axes) {
  const Eigen::Matrix3f R =
      Eigen::AngleAxisf(0.9F, Vec3(0.5F, 0.7F, -0.4F).normalized()).toRotationMatrix();
  const Eigen::Matrix3f G = R * (axes / std::cbrt(axes.prod())).asDiagonal() * R.transpose();
  Cloud cloud{particles(Points(center)), Records(2)};
  cloud.stretches[0] = {G(0, 0), G(1, 1), G(2, 2), 0};
  cloud.stretches[1] = {G(0, 1), G(0, 2), G(1, 2), 0};
  return cloud;
}

Eigen::Matrix3d stretch(const Cloud& cloud) {
  const Record& d = cloud.stretches[0];
  const Record& b = cloud.stretches[1];
  Eigen::Matrix3d G;
  G << d.x, b.x, b.y, b.x, d.y, b.z, b.y, b.z, d.z;
  return G;
}

DrawnSplats by_shaders(const GlFixture& gl, const Cloud& cloud, const RenderParams& params) {
  Sprites sprites;
  sprites.upload(cloud.centers, cloud.stretches);
  const Texture depth(kWidth, kHeight, Format::r32f), thickness(kWidth, kHeight, Format::r32f);
  const Texture back(kWidth, kHeight, Format::r32f);
  SphereDepth pass(glsl_source, true);
  pass(sprites, params, Framebuffer({&depth, &thickness, &back}));
  return {gl.read(depth), gl.read(thickness), gl.read(back)};
}

DrawnSplats in_cpp(const GlFixture& gl, const Cloud& cloud, const RenderParams& params) {
  return draw_splats(cloud.centers, cloud.stretches.data(), gl.frame(), kWidth, kHeight, params, 2);
}

/// At every pixel, by the quadratic of the ray o + t v and the surface |G^-1 (x - c)| = r.
void check(const GlFixture& gl,
           const Camera& camera,
           const Cloud& cloud,
           Real radius,
           const DrawnSplats& drawn) {
  const Eigen::Matrix4d view = camera.view().cast<double>();
  const Eigen::Matrix3d turn = view.topLeftCorner<3, 3>();
  const Record& at = cloud.centers[0];
  const Eigen::Vector3d c = turn * Eigen::Vector3d(at.x, at.y, at.z) + view.topRightCorner<3, 1>();
  const Eigen::Matrix3d back = (turn * stretch(cloud) * turn.transpose()).inverse();
  const double r2 = static_cast<double>(radius) * radius;
  int hits = 0;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      Eigen::Vector3d o(0, 0, 0), v(gl.slope_x(x), gl.slope_y(y), -1);
      if (camera.orthographic) {
        o = {v.x(), v.y(), 0};
        v = {0, 0, -1};
      }
      const Eigen::Vector3d bv = back * v, bc = back * (c - o);
      const double h = std::pow(bv.dot(bc), 2) - bv.squaredNorm() * (bc.squaredNorm() - r2);
      const double share = h / bv.squaredNorm() / r2;
      if (std::abs(share) < 0.02) continue;  // the rim, where the depth changes without limit
      const double front = (bv.dot(bc) - std::sqrt(h)) / bv.squaredNorm();
      const double end = (bv.dot(bc) + std::sqrt(h)) / bv.squaredNorm();
      const float a = drawn.depth[gl.at(x, y)];
      const float chord = drawn.thickness[gl.at(x, y)];
      CAPTURE(x);
      CAPTURE(y);
      const double near = camera.near;
      if (h < 0 || end < near) {
        CHECK(a == kNothing);
        CHECK(chord == 0);
        continue;
      }
      CHECK(chord == doctest::Approx((end - std::max(front, near)) * v.norm()).epsilon(1e-3));
      const float b = drawn.back[gl.at(x, y)];
      CHECK((camera.orthographic ? -b : 1 / b) == doctest::Approx(end).epsilon(2e-5));
      if (front < near) continue;
      ++hits;
      CHECK((camera.orthographic ? -a : 1 / a) == doctest::Approx(front).epsilon(2e-5));
    }
  }
  CHECK(hits > 60);
}

}  // namespace

TEST_CASE("ellipsoids: depth and chord by the formula, on and off the axis, no pixel lost") {
  for (const float fov : {20.0F, 60.0F, 100.0F, 0.0F}) {
    Camera camera;
    camera.eye = {0.3F, 0.2F, 0.1F};
    camera.target = {1, 0.5F, -2};
    camera.orthographic = fov == 0;
    camera.height = 2.4F;
    camera.fov_y = fov > 0 ? fov : camera.fov_y;
    const Real half = camera.half_height();
    const GlFixture gl(kWidth, kHeight, camera);
    RenderParams params;
    params.radius = camera.orthographic ? 0.3F : 0.45F * half;
    const Eigen::Matrix4f to_world = camera.view().inverse();
    for (const Vec3& axes : {Vec3(4, 4, 1), Vec3(1, 4, 1), Vec3(1, 2, 3), Vec3(1, 1, 1)}) {
      for (const Real off : {0.0F, 0.7F}) {
        const Real spread = camera.orthographic ? 1 : 3 * half;
        const Eigen::Vector4f center(off * spread, -0.8F * off * spread, -3, 1);
        const Cloud cloud = ellipsoid((to_world * center).head<3>(), axes);
        CAPTURE(fov);
        CAPTURE(axes);
        CAPTURE(off);
        check(gl, camera, cloud, params.radius, in_cpp(gl, cloud, params));
        check(gl, camera, cloud, params.radius, by_shaders(gl, cloud, params));
      }
    }
  }
}

TEST_CASE("ellipsoids: cut by the near plane, without an edge of its own") {
  Camera camera = GlFixture::looking_down_z();
  camera.near = 0.5F;
  const GlFixture gl(kWidth, kHeight, camera);
  RenderParams params;
  params.radius = 0.2F;
  for (const Vec3& center : {Vec3(0, 0, -0.7F), Vec3(0.2F, 0.1F, -0.66F)}) {
    const Cloud cloud = ellipsoid(center, {1, 1, 4});
    check(gl, camera, cloud, params.radius, in_cpp(gl, cloud, params));
    check(gl, camera, cloud, params.radius, by_shaders(gl, cloud, params));
  }
}
