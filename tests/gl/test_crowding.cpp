#include "pbf/core/isa.hpp"
#include "pbf/render/crowding.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <random>

using namespace pbf;

namespace {

const Vec3 kOrigin = Vec3::Zero();

Scalars crowding(const Points& positions, Real s, const Vec3& eye = kOrigin) {
  Crowding result;
  result.find(positions, eye, s);
  Scalars c(positions.cols());
  for (Index i = 0; i < positions.cols(); ++i) {
    const Record& particle = result.particles()[i];
    CHECK(Vec3(particle.x, particle.y, particle.z) == positions.col(i));
    c[i] = particle.w;
  }
  return c;
}

/// By the formula, over all pairs.
Scalars brute_force(const Points& x, double s) {
  const auto u = [&](Index i, Index j) {
    return 1 - (x.col(i).cast<double>() - x.col(j).cast<double>()).squaredNorm() / (s * s);
  };
  Eigen::ArrayXd m = Eigen::ArrayXd::Zero(x.cols());
  for (Index i = 0; i < x.cols(); ++i) {
    for (Index j = 0; j < x.cols(); ++j) {
      if (j != i && u(i, j) > 0) m[i] += u(i, j) * u(i, j);
    }
  }
  m = m.min(9);
  Scalars c(x.cols());
  for (Index i = 0; i < x.cols(); ++i) {
    double most = m[i];
    for (Index j = 0; j < x.cols(); ++j) {
      if (j != i && u(i, j) > 0) most = std::max(most, std::min(1.0, 1.5 * u(i, j)) * m[j]);
    }
    c[i] = static_cast<Real>(most / 9);
  }
  return c;
}

Points lattice(int nx, int ny, int nz) {
  Points x(3, nx * ny * nz);
  for (Index i = 0; i < x.cols(); ++i)
    x.col(i) = Eigen::Vector3<Index>(i % nx, i / nx % ny, i / (nx * ny)).cast<Real>();
  return x;
}

}  // namespace

TEST_CASE("crowding: the formula, for a cloud of drops, groups and bodies") {
  std::mt19937 random(7);
  std::normal_distribution<Real> spread(0, 1);
  Points x(3, 1500);
  for (Index i = 0; i < x.cols(); ++i) {
    const Real width = i < 500 ? 1.5F : i < 1000 ? 4.0F : 12.0F;
    x.col(i) = width * Vec3(spread(random), spread(random), spread(random)) + Vec3(30, -20, 5);
  }
  const Scalars c = crowding(x, 2.4F, {25, -20, 0});
  const Scalars expected = brute_force(x, 2.4);
  CHECK((c - expected).abs().maxCoeff() < 1e-4F);
  CHECK((expected == 1).count() > 400);
  CHECK((expected < 0.5F).count() > 200);
}

TEST_CASE("crowding: 0 alone, 1 everywhere in a body, between them in small groups") {
  CHECK(crowding(Points(Vec3(1, 2, 3)), 2.4F)[0] == 0);
  CHECK((crowding(lattice(8, 7, 9), 2.4F) > 0.85F).all());
  CHECK((crowding(lattice(8, 9, 1), 2.4F) - 0.53F).abs().maxCoeff() < 0.03F);
  CHECK((crowding(lattice(2, 2, 2), 2.4F) - 0.4F).abs().maxCoeff() < 0.05F);
  CHECK((crowding(lattice(9, 1, 1), 2.4F) < 0.25F).all());
  CHECK(crowding(Points(3, 0), 2.4F).size() == 0);
}

TEST_CASE("crowding: piles, and particles too far away to be seen, are bodies") {
  CHECK((crowding(Points::Zero(3, 20000), 1.0F) == 1).all());
  const Points far{{0, 1e30F}, {0, 0}, {0, -3e38F}};
  const Scalars c = crowding(far, 1.0F);
  CHECK(c[0] == 0);
  CHECK(c[1] == 1);
}

TEST_CASE("crowding: with s = 0 nothing is looked at and all is a body") {
  CHECK((crowding(lattice(3, 1, 1), 0) == 1).all());
}

TEST_CASE("crowding: the same bits for any number of threads and every instruction set") {
  std::mt19937 random(11);
  std::uniform_real_distribution<Real> anywhere(0, 1);
  Points x(3, 20000);
  for (Index i = 0; i < x.cols(); ++i) {
    const Real side = i < 15000 ? 24 : 60;  // a body in spray
    x.col(i) = side * Vec3(anywhere(random), anywhere(random), anywhere(random));
  }
  const auto found = [&](int threads) {
    Crowding crowding;
    crowding.find(x, kOrigin, 2.4F, threads);
    std::vector<Real> c;
    for (Index i = 0; i < x.cols(); ++i) c.push_back(crowding.particles()[i].w);
    return c;
  };
  const std::vector<Real> expected = found(1);
  CHECK(std::ranges::count(expected, 1) > 5000);
  CHECK(std::ranges::count_if(expected, [](Real c) { return c < 0.5F; }) > 1000);
  for (const int threads : {2, 3, 7}) CHECK(found(threads) == expected);
  for (const Isa isa : usable_isas()) {
    setenv("PBF_ISA", isa_name(isa), 1);
    CAPTURE(isa_name(isa));
    CHECK(found(2) == expected);
  }
  unsetenv("PBF_ISA");
}
