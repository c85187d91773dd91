#include "pbf/render/anisotropy.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <doctest/doctest.h>

#include "clouds.hpp"
#include "instruction_sets.hpp"
#include <random>

using namespace pbf;
using test::for_each_isa;
using test::lattice;

namespace {

constexpr Real kDistance = 2.4F;  // of the particles that count, in particle distances

Anisotropy found_around(const Points& x, Real anisotropy, const Vec3& eye, int threads = 0) {
  Camera camera;
  camera.eye = eye;
  camera.target = eye - Vec3::UnitZ();
  Neighborhoods particles;
  particles.find(x, camera, kDistance, 0, Neighborhoods::Deep::last,  // small sprites hide nothing
                 Neighborhoods::Sorted::shallow, threads);
  for (Index i = 0; i < x.cols(); ++i) particles.particles()[i].w = 0.5F;
  Anisotropy found;
  found.find(particles, x.cols(), anisotropy, threads);
  return found;
}

struct Ellipsoid {
  Vec3 center;
  Eigen::Matrix3f stretch;
};

std::vector<Ellipsoid> ellipsoids(const Points& x,
                                  Real anisotropy = 1,
                                  const Vec3& eye = Vec3::Zero()) {
  const Anisotropy found = found_around(x, anisotropy, eye);
  std::vector<Ellipsoid> result;
  for (Index i = 0; i < x.cols(); ++i) {
    const Record& c = found.centers()[i];
    CHECK(c.w == 0.5F);
    const Record& d = found.stretches()[2 * i];
    const Record& b = found.stretches()[2 * i + 1];
    Eigen::Matrix3f G;
    G << d.x, b.x, b.y, b.x, d.y, b.z, b.y, b.z, d.z;
    result.push_back({{c.x, c.y, c.z}, G});
  }
  return result;
}

Eigen::Matrix3f turn() {
  return Eigen::AngleAxisf(1.1F, Vec3(0.6F, -0.3F, 0.8F).normalized()).toRotationMatrix();
}

bool is_sphere(const Ellipsoid& e, Real tolerance) {
  return (e.stretch - Eigen::Matrix3f::Identity()).cwiseAbs().maxCoeff() <= tolerance;
}

}  // namespace

TEST_CASE("anisotropy: a particle alone, and one too far away to be seen, stays the sphere it is") {
  const Points x{{1, 5, 1e30F}, {2, 2, 0}, {3, 3, -3e38F}};
  for (Index i = 0; i < 3; ++i) {
    const Ellipsoid e = ellipsoids(x)[static_cast<std::size_t>(i)];
    CHECK(e.center == x.col(i));
    CHECK(is_sphere(e, 0));
  }
  CHECK(ellipsoids(Points(3, 0)).empty());
}

TEST_CASE("anisotropy: a particle in the midst of a body stays a sphere, and where it is") {
  Points x = lattice(9, 9, 9);
  const Ellipsoid middle = ellipsoids(x)[364];
  CHECK((middle.center - x.col(364)).norm() < 1e-5F);
  CHECK(is_sphere(middle, 1e-4F));
  // Shaken by a fifth of the distance: nearly.
  std::mt19937 random(1);
  std::uniform_real_distribution<Real> shake(-0.2F, 0.2F);
  for (Real& number : x.reshaped()) number += shake(random);
  CHECK(is_sphere(ellipsoids(x)[364], 0.35F));
}

TEST_CASE("anisotropy: in a sheet flat along it, four times as wide as thick, with its volume") {
  const Eigen::Matrix3f R = turn();
  const Points x = R * lattice(9, 9, 1);
  const Ellipsoid middle = ellipsoids(x)[40];
  CHECK((middle.center - x.col(40)).norm() < 1e-5F);
  const Vec3 axes(std::cbrt(4.0F), std::cbrt(4.0F), std::cbrt(1 / 16.0F));
  CHECK((R.transpose() * middle.stretch * R - Eigen::Matrix3f(axes.asDiagonal())).norm() < 1e-4F);
}

TEST_CASE("anisotropy: in a row of particles long, and less with less of it") {
  const Eigen::Matrix3f R = turn();
  const Points x = R * lattice(9, 1, 1);
  // Sum of the weights of the two pairs of neighbors over the least sum that stretches fully.
  const double sum = 2 * (1 - std::pow(1 / 2.4, 3)) + 2 * (1 - std::pow(2 / 2.4, 3));
  for (const double anisotropy : {1.0, 0.5}) {
    const double a = anisotropy * sum / Anisotropy::kFewest;
    const Vec3 axes = Eigen::Array3d(std::cbrt(16.0), std::cbrt(0.25), std::cbrt(0.25))
                          .pow(a)
                          .matrix()
                          .cast<Real>();
    const Ellipsoid middle = ellipsoids(x, static_cast<Real>(anisotropy))[4];
    CHECK((R.transpose() * middle.stretch * R - Eigen::Matrix3f(axes.asDiagonal())).norm() < 1e-4F);
  }
}

TEST_CASE("anisotropy: the formula, in any body, and the same volume everywhere") {
  std::mt19937 random(5);
  std::uniform_real_distribution<Real> anywhere(-4, 4);
  Points x(3, 400);
  for (Real& number : x.reshaped()) number = anywhere(random);
  const std::vector<Ellipsoid> found = ellipsoids(x, 0.8F, {2, -3, 1});
  for (Index i = 0; i < x.cols(); ++i) {
    double w = 0;
    Eigen::Vector3d m = Eigen::Vector3d::Zero();
    Eigen::Matrix3d C = Eigen::Matrix3d::Zero();
    for (const bool second : {false, true}) {
      for (Index j = 0; j < x.cols(); ++j) {
        const Eigen::Vector3d r = (x.col(j) - x.col(i)).cast<double>();
        const double w_j = 1 - std::pow(r.norm() / kDistance, 3);
        if (w_j <= 0) continue;
        if (!second) {
          w += w_j;
          m += w_j * r;
        } else {
          C += w_j / w * (r - m) * (r - m).transpose();
        }
      }
      if (!second) m /= w;
    }
    const double a = static_cast<double>(0.8F) * std::min(1.0, (w - 1) / Anisotropy::kFewest);
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(C);
    Eigen::Array3d axes = solver.eigenvalues();
    axes = axes.max(axes[2] / Anisotropy::kMostRatio);
    axes = a > 0 ? Eigen::Array3d((axes / std::cbrt(axes.prod())).pow(a)) : Eigen::Array3d(1, 1, 1);
    const Eigen::Matrix3d G =
        solver.eigenvectors() * axes.matrix().asDiagonal() * solver.eigenvectors().transpose();
    const Ellipsoid& e = found[static_cast<std::size_t>(i)];
    CAPTURE(i);
    CHECK((e.stretch.cast<double>() - G).norm() < 1e-4);
    const Eigen::Vector3d center = x.col(i).cast<double>() + Anisotropy::kCenterShare * a * m;
    CHECK((e.center.cast<double>() - center).norm() < 1e-5);
    CHECK(e.stretch.determinant() == doctest::Approx(1).epsilon(1e-4));
  }
}

TEST_CASE("anisotropy: the same bits for any number of threads and every instruction set") {
  std::mt19937 random(11);
  std::uniform_real_distribution<Real> anywhere(0, 20);
  Points x(3, 12000);
  for (Real& number : x.reshaped()) number = anywhere(random);
  const auto found = [&](int threads) {
    const Anisotropy anisotropy = found_around(x, 1, Vec3::Zero(), threads);
    std::vector<Real> numbers;
    const auto add = [&](const Record& r) { numbers.insert(numbers.end(), {r.x, r.y, r.z}); };
    for (Index i = 0; i < x.cols(); ++i) add(anisotropy.centers()[i]);
    for (Index i = 0; i < 2 * x.cols(); ++i) add(anisotropy.stretches()[i]);
    return numbers;
  };
  const std::vector<Real> expected = found(1);
  for (const int threads : {2, 3, 7}) CHECK(found(threads) == expected);
  for_each_isa([&] { CHECK(found(2) == expected); });
}
