#include "pbf/render/nearest.hpp"

#include <doctest/doctest.h>

#include "clouds.hpp"

using namespace pbf;

TEST_CASE("nearest_front: of the spheres that reach into the picture the nearest") {
  Camera camera;
  camera.eye = {0, 0, 5};
  camera.target = {0, 0, 0};
  camera.fov_y = 90;
  camera.near = 0.5F;
  camera.far = 20;
  const auto nearest = [&](const Points& x, Real radius = 0.25F) {
    return nearest_front(x, radius, frame_block(camera, 64, 64), 0);
  };
  const Points x = 0.1F * test::lattice(12, 12, 12);  // at depths from 5 to 3.9
  CHECK(nearest(x) == doctest::Approx(3.9F - 0.25F));
  Points with(3, x.cols() + 1);
  with.leftCols(x.cols()) = x;
  with.col(x.cols()) << 0, 0, 4;
  CHECK(nearest(with) == doctest::Approx(0.75F));
  with.col(x.cols()) << 0, 0, 4.6F;  // the near plane cuts it open
  CHECK(nearest(with) == 0.5F);
  with.col(x.cols()) << 1.3F, 0, 4;  // beside the picture, but it reaches into it
  CHECK(nearest(with) == doctest::Approx(0.75F));
  with.col(x.cols()) << 1.4F, 0, 4;
  CHECK(nearest(with) == doctest::Approx(3.9F - 0.25F));
  with.col(x.cols()) << 0, 0, 6;  // behind the eye
  CHECK(nearest(with) == doctest::Approx(3.9F - 0.25F));
  CHECK(nearest(Points(3, 0)) == 20);
  CHECK(nearest(Points(Vec3(0, 0, -100))) == 20);
}
