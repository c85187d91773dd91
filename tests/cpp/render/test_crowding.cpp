#include "pbf/render/crowding.hpp"
#include "pbf/render/params.hpp"

#include <doctest/doctest.h>

#include "clouds.hpp"
#include "instruction_sets.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <set>

using namespace pbf;
using test::for_each_isa;
using test::lattice;

namespace {

Camera camera_at(const Vec3& eye) {
  Camera camera;
  camera.eye = eye;
  camera.target = eye - Vec3::UnitZ();
  return camera;
}

struct Found {
  Points x;
  Scalars c;
  Index deep;
};

/// With sprites of half of s: those of a body hide what is deep in it.
Found find(const Points& positions, Real s, const Camera& camera = camera_at(Vec3::Zero())) {
  Neighborhoods result;
  result.find(positions, camera, s, 0.5F * s, Neighborhoods::Deep::last,
              Neighborhoods::Sorted::around_loose);
  Crowding().find(result);
  const Index n = positions.cols();
  Found found{Points(3, n), Scalars(n), n - result.shallow_count()};
  for (Index i = 0; i < n; ++i) {
    const Record& particle = result.particles()[i];
    found.x.col(i) << particle.x, particle.y, particle.z;
    found.c[i] = particle.w;
  }
  CHECK(result.shallow() == found.x.leftCols(result.shallow_count()));
  return found;
}
Scalars crowding(const Points& positions, Real s) { return find(positions, s).c; }

/// The columns in an order that does not depend on theirs.
std::vector<std::array<Real, 3>> sorted(const Points& x) {
  std::vector<std::array<Real, 3>> columns;
  for (Index i = 0; i < x.cols(); ++i) columns.push_back({x(0, i), x(1, i), x(2, i)});
  std::ranges::sort(columns);
  return columns;
}

/// Whether each is in a block of 27 cells that all hold particles.
std::vector<bool> in_body(const Points& x, double side) {
  using Cell = std::array<int, 3>;
  const auto cell_of = [&](Index i) {
    Cell cell;
    for (int k = 0; k < 3; ++k) cell[k] = static_cast<int>(std::floor(double(x(k, i)) / side));
    return cell;
  };
  const auto among_27 = [](const std::set<Cell>& cells, const Cell& at) {
    int count = 0;
    for (int k = 0; k < 27; ++k) {
      count +=
          cells.contains({at[0] + k % 3 - 1, at[1] + k / 3 % 3 - 1, at[2] + k / 9 - 1}) ? 1 : 0;
    }
    return count;
  };
  std::set<Cell> holding, full;
  for (Index i = 0; i < x.cols(); ++i) holding.insert(cell_of(i));
  for (const Cell& cell : holding) {
    if (among_27(holding, cell) == 27) full.insert(cell);
  }
  std::vector<bool> found;
  for (Index i = 0; i < x.cols(); ++i) found.push_back(among_27(full, cell_of(i)) > 0);
  return found;
}

/// By the formula, over all pairs. Without bodies where there would be too many cells.
Scalars brute_force(const Points& x, Real s, bool has_cells = true) {
  const auto u = [&](Index i, Index j) {
    return 1 - (x.col(i).cast<double>() - x.col(j).cast<double>()).squaredNorm() / (s * s);
  };
  const std::vector<bool> body = in_body(x, 0.6F * s);
  Eigen::ArrayXd m = Eigen::ArrayXd::Zero(x.cols());
  for (Index i = 0; i < x.cols(); ++i) {
    for (Index j = 0; j < x.cols(); ++j) {
      if (j != i && u(i, j) > 0) m[i] += u(i, j) * u(i, j);
    }
    if (has_cells && body[static_cast<std::size_t>(i)]) m[i] = 9;
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

}  // namespace

TEST_CASE("crowding: the formula, for a cloud of drops, groups and bodies") {
  for (const Real widest : {6.0F, 12.0F}) {
    std::mt19937 random(7);
    std::normal_distribution<Real> spread(0, 1);
    Points x(3, 1500);
    for (Index i = 0; i < x.cols(); ++i) {
      const Real width = i < 500 ? 1.5F : i < 1000 ? widest / 3 + 1 : widest;
      x.col(i) = width * Vec3(spread(random), spread(random), spread(random)) + Vec3(30, -20, 5);
    }
    const Found found = find(x, 2.4F, camera_at({25, -20, 0}));
    const Scalars expected = brute_force(found.x, 2.4F, widest < 12);
    CHECK(sorted(found.x) == sorted(x));
    CHECK((found.c - expected).abs().maxCoeff() < 1e-4F);
    CHECK((expected == 1).count() > 400);
    CHECK((expected < 0.5F).count() > 200);
  }
}

TEST_CASE("crowding: of a body that shakes, a million of which would be too many for pairs") {
  std::mt19937 random(5);
  std::uniform_real_distribution<Real> shake(-0.2F, 0.2F);
  Points x = lattice(16, 14, 15);
  for (Real& coordinate : x.reshaped()) coordinate += shake(random);
  const Found found = find(x, 2.4F, camera_at({7, 7, 40}));
  CHECK(sorted(found.x) == sorted(x));
  CHECK(found.deep > 100);
  CHECK((found.c - brute_force(found.x, 2.4F)).abs().maxCoeff() < 1e-4F);
  // Deep ones come last, and nothing around them is missing.
  const Points deep = found.x.rightCols(found.deep);
  CHECK(deep.minCoeff() > 2);
  CHECK((deep.rowwise().maxCoeff().array() < Eigen::Array3f(13, 11, 12)).all());
  CHECK((found.c.tail(found.deep) == 1).all());
}

TEST_CASE("crowding: nothing is hidden from within, by the near plane, or by small sprites") {
  const Points x = lattice(20, 20, 20);
  const auto deep = [&](const Camera& camera, Real radius = 1.2F) {
    Neighborhoods particles;
    particles.find(x, camera, 2.4F, radius, Neighborhoods::Deep::left_out,
                   Neighborhoods::Sorted::shallow);
    CHECK(particles.particles().size() == particles.shallow_count());
    return x.cols() - particles.shallow_count();
  };
  Camera camera = camera_at({10, 10, 40});
  const Index from_outside = deep(camera);
  CHECK(from_outside > 1000);
  CHECK(deep(camera, 0.9F) == 0);
  camera.near = 30;  // through the middle
  CHECK(deep(camera) < from_outside / 2);
  CHECK(deep(camera) > 0);
  CHECK(deep(camera_at({10, 10, 10})) == deep(camera));
}

TEST_CASE("crowding: a body is one for sprites of 0.8 to 1.5 particle distances") {
  std::mt19937 random(9);
  std::uniform_real_distribution<Real> shake(-0.2F, 0.2F);
  Points x = lattice(9, 9, 9);
  for (Real& coordinate : x.reshaped()) coordinate += shake(random);
  x *= 0.02F;
  for (const Real spacings : {0.8F, 1.0F, 1.2F, 1.5F}) {
    CAPTURE(spacings);
    RenderParams params;
    params.radius = spacings * 0.02F;
    params.drop_radius = 0.0124F;
    params.particle_volume = 8e-6F;
    const Found found = find(x, params.neighbor_distance());
    for (Index i = 0; i < x.cols(); ++i) {
      const auto inner = (found.x.col(i).array() - 0.08F).abs() < 0.05F;
      if (inner.all()) CHECK(found.c[i] == 1);
    }
    CHECK(found.c.minCoeff() > 0.8F);  // a corner
  }
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
    Neighborhoods particles;
    particles.find(x, camera_at(Vec3::Zero()), 2.4F, 1.2F, Neighborhoods::Deep::last,
                   Neighborhoods::Sorted::around_loose, threads);
    Crowding().find(particles, threads);
    std::vector<Real> c;
    for (Index i = 0; i < x.cols(); ++i) c.push_back(particles.particles()[i].w);
    return c;
  };
  const std::vector<Real> expected = found(1);
  CHECK(std::ranges::count(expected, 1) > 5000);
  CHECK(std::ranges::count_if(expected, [](Real c) { return c < 0.5F; }) > 1000);
  for (const int threads : {2, 3, 7}) CHECK(found(threads) == expected);
  for_each_isa([&] { CHECK(found(2) == expected); });
}
