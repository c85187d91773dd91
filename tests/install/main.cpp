// Steps a dam break and draws it, with nothing but what `cmake --install` gives.
#include "pbf/fluid/simulation.hpp"
#include "pbf/scene/shapes.hpp"

#include <algorithm>
#include <cstdio>
#ifdef HAVE_RENDER
#include "pbf/render/fluid_renderer.hpp"
#endif

int main() {
  const pbf::FluidParams fluid;
  pbf::Simulation simulation(fluid, {}, pbf::Box{.lower{0, 0, 0}, .upper{0.6F, 0.4F, 0.2F}});
  simulation.add_particles(pbf::block({0, 0, 0}, {0.2F, 0.2F, 0.2F}, fluid.spacing));
  for (int frame = 0; frame < 5; ++frame) simulation.advance(1.0F / 60);

  const pbf::Points x = simulation.positions();
  if (x.cols() != 1000 || !x.allFinite() || !(x.row(0).maxCoeff() > 0.2F)) {
    std::puts("the dam did not break");
    return 1;
  }
#ifdef HAVE_RENDER
  pbf::FluidRenderer renderer(64, 36);
  const pbf::Camera camera{.eye{0.3F, 0.3F, 1}, .target{0.3F, 0.1F, 0.1F}};
  const pbf::Layers layers = renderer.layers(x, camera, {.radius = fluid.spacing});
  if (std::ranges::max(layers.depth.data) <= 0) {
    std::puts("no fluid in the picture");
    return 1;
  }
  std::puts("drawn");
#endif
  std::printf("%lld particles after %.3f s\n", static_cast<long long>(x.cols()), simulation.time());
  return 0;
}
