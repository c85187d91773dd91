/// The passes of a frame, in C++ (cpp), with ellipsoids, and as shaders (glsl): milliseconds of
/// each, and how much work there was. The same dam break, in the same picture, of few and of many
/// particles.
#include "pbf/render/cpu_renderer.hpp"
#include "pbf/render/fluid_renderer.hpp"
#include "pbf/render/neighborhoods.hpp"

#include <benchmark/benchmark.h>

#include "stages.hpp"
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <type_traits>

namespace pbf::bench {
namespace {

constexpr Real kEdge = 0.78F;  // of the block [m]

struct Cloud {
  Points positions;
  Real spacing;
};

const Cloud& cloud(Index n) {
  static std::map<Index, Cloud> clouds;
  const auto found = clouds.find(n);
  if (found != clouds.end()) return found->second;
  const Points& x = dam_break_positions(n);
  const Real spacing = kEdge / static_cast<Real>(std::lround(std::cbrt(n)));
  const Real scale = kEdge / x.row(2).maxCoeff();
  return clouds.emplace(n, Cloud{scale * x, spacing}).first->second;
}

Camera camera() {
  Camera camera;
  camera.eye = {2.9F, 1.5F, 2.7F};
  camera.target = {0.9F, 0.35F, 0.4F};
  return camera;
}

RenderParams params(Real spacing) {
  RenderParams params;
  params.radius = 1.2F * spacing;
  params.drop_radius = 0.62F * spacing;
  params.particle_volume = spacing * spacing * spacing;
  return params;
}

/// Pixels that sprites cover, each of its own; of full size, as most are. In C++ deep ones are not
/// drawn.
double fragments(const Cloud& of, const RenderParams& drawn, double pixels_per_slope, bool in_cpp) {
  Neighborhoods particles;
  particles.find(of.positions, camera(), drawn.neighbor_distance(), drawn.radius,
                 Neighborhoods::Deep::last, Neighborhoods::Sorted::around_loose);
  const Eigen::Matrix4f view = camera().view();
  const double r2 = std::pow(static_cast<double>(drawn.radius), 2);
  double sum = 0;
  const Index drawn_count = in_cpp ? particles.shallow_count() : of.positions.cols();
  for (Index i = 0; i < drawn_count; ++i) {
    const Record& p = particles.particles()[i];
    const double z = -(view.row(2).head<3>().dot(Vec3(p.x, p.y, p.z)) + view(2, 3));
    sum += std::numbers::pi * r2 * pixels_per_slope * pixels_per_slope / (z * z - r2);
  }
  return sum;
}

/// Neighbors that an iteration of a filter looks at.
double taps(const Layers& layers, Real radius, double pixels_per_slope) {
  double sum = 0;
  for (const float d : layers.depth.data) {
    if (d > 0) sum += 4 * std::min(24.0, std::ceil(radius * pixels_per_slope / d));
  }
  return sum;
}

template <class Renderer>
void draw(benchmark::State& state, Real anisotropy) {
  const Cloud& of = cloud(state.range(0));
  const auto height = static_cast<int>(state.range(1));
  Renderer renderer(height * 16 / 9, height);
  RenderParams drawn = params(of.spacing);
  drawn.anisotropy = anisotropy;
  const Layers layers = renderer.layers(of.positions, camera(), drawn);
  renderer.render(of.positions, camera(), drawn);  // allocates
  renderer.set_timed(true);
  std::map<std::string, double> total;
  for (auto _ : state) {
    renderer.render(of.positions, camera(), drawn);
    for (const auto& [name, milliseconds] : renderer.report().milliseconds) {
      total["ms_" + name] += milliseconds;
    }
  }
  for (const auto& [name, milliseconds] : total) {
    state.counters[name] = milliseconds / static_cast<double>(state.iterations());
  }
  const double pixels_per_slope = height / (2.0 * static_cast<double>(camera().half_height()));
  state.counters["particles"] = static_cast<double>(of.positions.cols());
  state.counters["fragments"] =
      fragments(of, drawn, pixels_per_slope, std::is_same_v<Renderer, CpuRenderer>);
  state.counters["pixels"] =
      static_cast<double>(std::ranges::count_if(layers.depth.data, [](float d) { return d > 0; }));
  state.counters["depth_taps"] = static_cast<double>(drawn.smoothing_iterations) *
                                 taps(layers, drawn.smoothing_radius_in_force(), pixels_per_slope);
  state.counters["thickness_taps"] =
      static_cast<double>(drawn.thickness_iterations) *
      taps(layers, drawn.thickness_radius_in_force(), pixels_per_slope);
}

void frames(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgNames({"n", "height"})
      ->ArgsProduct({{59'319, 1'000'000}, {720, 1080, 2160}})
      ->UseRealTime()
      ->Unit(benchmark::kMillisecond);
}

void cpp(benchmark::State& state) { draw<CpuRenderer>(state, 0); }
void cpp_ellipsoids(benchmark::State& state) { draw<CpuRenderer>(state, 1); }
void glsl(benchmark::State& state) { draw<FluidRenderer>(state, 0); }

BENCHMARK(cpp)->Apply(frames);
BENCHMARK(cpp_ellipsoids)->Apply(frames);
BENCHMARK(glsl)->Apply(frames);

}  // namespace
}  // namespace pbf::bench
