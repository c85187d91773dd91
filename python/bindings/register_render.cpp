#include "pbf/render/fluid_renderer.hpp"

#include "bind_params.hpp"
#include "numpy_io.hpp"
#include <mutex>

namespace pbf {
namespace {

template <class T>
py::array_t<T> pixels_to_numpy(Pixels<T>&& pixels) {
  std::vector<py::ssize_t> shape{pixels.height, pixels.width};
  if (pixels.channels > 1) shape.push_back(pixels.channels);
  auto owned = std::make_unique<std::vector<T>>(std::move(pixels.data));
  T* data = owned->data();
  py::capsule owner(owned.release(), [](void* p) { delete static_cast<std::vector<T>*>(p); });
  return py::array_t<T>(std::move(shape), data, owner);
}

/// A FluidRenderer that several Python threads may call, in turn, and that can be closed.
class Renderer {
 private:
  /// Runs f without the GIL, one thread at a time. The GIL goes first: waiting with it for a thread
  /// that wants it would never end.
  template <class F>
  auto with_lock(F&& f) {
    const py::gil_scoped_release unlocked;
    const std::lock_guard guard(lock_);
    return f();
  }
  template <class F>
  auto draw(py::handle positions, F&& f) {
    const FloatArray array = points_array(positions, "positions");
    const auto view = points_view(array);
    return with_lock([&] { return f(view); });
  }
  FluidRenderer& open() {
    if (renderer_ == nullptr) {
      throw GlError("the renderer is closed; make a new one");
    }
    return *renderer_;
  }

  std::mutex lock_;
  std::unique_ptr<FluidRenderer> renderer_;

 public:
  Renderer(int width, int height, bool timed) {
    const py::gil_scoped_release unlocked;  // looking for a device takes a while
    renderer_ = std::make_unique<FluidRenderer>(width, height);
    renderer_->set_timed(timed);
  }

  py::array_t<std::uint8_t> render(py::handle positions,
                                   const Camera& camera,
                                   const RenderParams& params) {
    return pixels_to_numpy(
        draw(positions, [&](PointsView x) { return open().render(x, camera, params); }));
  }

  py::dict layers(py::handle positions, const Camera& camera, const RenderParams& params) {
    Layers layers = draw(positions, [&](PointsView x) { return open().layers(x, camera, params); });
    return py::dict("depth"_a = pixels_to_numpy(std::move(layers.depth)),
                    "depth_smooth"_a = pixels_to_numpy(std::move(layers.depth_smooth)),
                    "thickness"_a = pixels_to_numpy(std::move(layers.thickness)),
                    "thickness_smooth"_a = pixels_to_numpy(std::move(layers.thickness_smooth)),
                    "normal"_a = pixels_to_numpy(std::move(layers.normal)));
  }

  py::dict report() {
    py::dict milliseconds;
    const RenderReport report = with_lock([&] { return open().report(); });
    for (const auto& [name, time] : report.milliseconds) milliseconds[name.c_str()] = time;
    return py::dict("particles"_a = report.particles, "milliseconds"_a = milliseconds);
  }

  py::dict info() {
    const auto text = with_lock([&] {
      const auto& info = open().context().info();
      return std::array{info.renderer, info.vendor, info.version, info.platform};
    });
    return py::dict("renderer"_a = text[0], "vendor"_a = text[1], "version"_a = text[2],
                    "platform"_a = text[3]);
  }
  std::string description() {
    return with_lock([&] { return open().context().description(); });
  }
  void close() {
    with_lock([&] { renderer_.reset(); });
  }
  bool closed() {
    return with_lock([&] { return renderer_ == nullptr; });
  }
};

}  // namespace

void register_render(py::module_& m) {
  bind_params<Camera>(m, "Where the picture is taken from.");
  bind_params<RenderParams>(m, "How the fluid is drawn. SI units; colors are linear, 0 to 1.");
  py::class_<Renderer>(m, "Renderer", "Draws particles as a fluid, without a screen.")
      .def(py::init<int, int, bool>(), "width"_a, "height"_a, "timed"_a = false)
      .def("render", &Renderer::render, "positions"_a, "camera"_a, "params"_a)
      .def("layers", &Renderer::layers, "positions"_a, "camera"_a, "params"_a)
      .def("close", &Renderer::close)
      .def_property_readonly("closed", &Renderer::closed)
      .def_property_readonly("description", &Renderer::description)
      .def_property_readonly("info", &Renderer::info)
      .def_property_readonly("report", &Renderer::report);
}

}  // namespace pbf
