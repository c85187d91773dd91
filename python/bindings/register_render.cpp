#include "pbf/gl/egl_cures.hpp"
#include "pbf/gl/egl_device.hpp"
#include "pbf/gl/egl_turn.hpp"
#include "pbf/render/cpu_renderer.hpp"
#include "pbf/render/fluid_renderer.hpp"
#include "pbf/render/legend.hpp"

#include "bind_params.hpp"
#include "numpy_io.hpp"
#include <algorithm>
#include <mutex>
#include <optional>
#include <unistd.h>

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

py::dict as_dict(const EglDevice& device) {
  return py::dict("index"_a = device.index, "name"_a = device.name, "software"_a = device.software,
                  "cuda"_a = device.cuda, "file"_a = device.file);
}

py::list egl_device_dicts() {
  std::vector<EglDevice> devices;
  {
    const WithoutGil unlocked;
    const EglTurn turn;
    std::vector<std::string> notes;
    devices = egl_devices(notes);
  }
  py::list list;
  for (const EglDevice& device : devices) list.append(as_dict(device));
  return list;
}

Mesh make_mesh(py::handle vertices, py::handle faces, const std::array<double, 3>& color) {
  const FloatArray points = points_array(vertices, "vertices");
  require_unmasked(faces, "faces");
  const py::array indices = py::array::ensure(faces);
  const char kind = indices ? indices.dtype().kind() : 'O';
  if (kind != 'i' && kind != 'u') {
    PyErr_Clear();
    raise("WrongType", "faces: expected an array of whole numbers, three vertices a row");
  }
  if (indices.ndim() != 2 || indices.shape(1) != 3) {
    throw InvalidParameter("faces: expected shape (m, 3), three vertices a row, got " +
                           shape_text(indices));
  }
  const py::array_t<std::int64_t, py::array::c_style | py::array::forcecast> numbers(indices);
  std::vector<Mesh::Triangle> triangles(static_cast<std::size_t>(numbers.shape(0)));
  std::copy_n(numbers.data(), numbers.size(), triangles.empty() ? nullptr : triangles[0].data());
  return {
      points_view(points), std::move(triangles),
      Vec3(static_cast<Real>(color[0]), static_cast<Real>(color[1]), static_cast<Real>(color[2]))};
}

EnvironmentMap environment_map(py::handle object) {
  const FloatArray array = float_array(object, "environment_map");
  if (array.ndim() != 3 || array.shape(2) != 3) {
    throw InvalidParameter("environment_map: expected shape (height, width, 3), got " +
                           shape_text(array));
  }
  return {static_cast<int>(array.shape(1)), static_cast<int>(array.shape(0)), 3,
          std::vector<float>(array.data(), array.data() + array.size())};
}

/// What a list holds beside meshes, None among it, is no mesh.
Meshes meshes_of(const py::list& list) {
  Meshes meshes;
  for (const py::handle item : list) {
    if (!py::isinstance<Mesh>(item)) {
      raise("WrongType", "meshes[" + std::to_string(meshes.size()) +
                             "] = " + py::repr(item).cast<std::string>() + ": must be a Mesh");
    }
    meshes.push_back(item.cast<std::shared_ptr<Mesh>>());
  }
  return meshes;
}

/// A FluidRenderer that several Python threads may call, in turn, and that can be closed.
class Renderer {
 private:
  /// Runs f without the GIL, one thread at a time. The GIL goes first: waiting with it for a thread
  /// that wants it would never end. Nor would waiting for a thread that fork() has left behind.
  template <class F>
  auto with_lock(F&& f) {
    const WithoutGil unlocked;
    require_process(process_);
    const std::lock_guard guard(lock_);
    return f();
  }
  template <class F>
  auto draw(py::handle positions, F&& f) {
    const FloatArray array = points_array(positions, "positions");
    const auto view = points_view(array);
    return with_lock([&] { return f(view); });
  }
  void require_open() const {
    if (renderer_ == nullptr && cpu_ == nullptr) {
      throw GlError("the renderer is closed; make a new one");
    }
  }
  /// Calls f with the one that draws.
  template <class F>
  auto with_open(F&& f) {
    require_open();
    return cpu_ ? f(*cpu_) : f(*renderer_);
  }
  const RenderReport& last_report() const {
    require_open();
    return cpu_ ? cpu_->report() : renderer_->report();
  }

  void draw_in_cpp(int width, int height, const std::string& why) {
    cpu_ = std::make_unique<CpuRenderer>(width, height);
    description_ = "C++ on the processor, no OpenGL";
    info_.renderer = description_;
    info_.platform = "processor";
    info_.choice = why;
    info_.software = true;
  }
  /// @param shaders  whatever the driver; if not, C++ draws where the driver would use the
  ///                 processor, and where nobody asked for a device and there is no driver
  void find_driver(int width, int height, const std::string& device, bool shaders) {
    { const EglTurn turn; }  // none after fork(): that is no machine without OpenGL
    std::unique_ptr<EglContext> context;
    try {
      context = std::make_unique<EglContext>(device);
    } catch (const RendererUnavailable& error) {
      if (shaders || !device_wish(device).source.empty()) throw;
      missing_ = error.what();
      draw_in_cpp(width, height, "there is no OpenGL");
      return;
    }
    info_ = context->info();
    description_ = context->description();
    if (shaders || !info_.software) {
      renderer_ = std::make_unique<FluidRenderer>(width, height, std::move(context));
    } else {
      cpu_ = std::make_unique<CpuRenderer>(width, height);
      description_ = "C++ on the processor, in place of " + description_;
    }
  }

  const int process_ = getpid();
  std::mutex lock_;
  // One of these.
  std::unique_ptr<FluidRenderer> renderer_;
  std::unique_ptr<CpuRenderer> cpu_;
  EglContext::Info info_;  ///< of the context: known without a turn at it, and after close() too
  std::string description_;
  std::string missing_;  ///< why there is no OpenGL, if nobody asked for that

 public:
  Renderer(int width,
           int height,
           const std::string& device,
           bool timed,
           const std::optional<std::string>& backend) {
    if (backend && *backend != "egl" && *backend != "cpu") {
      throw InvalidParameter("backend = \"" + *backend +
                             "\": must be \"egl\", \"cpu\" or None, which chooses");
    }
    const WithoutGil unlocked;  // looking for a device takes a while
    if (backend == "cpu") {
      draw_in_cpp(width, height, "asked for");
      info_.asked_for = true;
    } else {
      find_driver(width, height, device, backend.has_value());
    }
    if (renderer_) renderer_->set_timed(timed);
    if (cpu_) cpu_->set_timed(timed);
  }

  py::array_t<std::uint8_t> render(py::handle positions,
                                   const Camera& camera,
                                   const RenderParams& params,
                                   const py::list& meshes,
                                   const py::object& values) {
    const Meshes all = meshes_of(meshes);
    FloatArray numbers(std::vector<py::ssize_t>{0});
    if (!values.is_none()) {
      numbers = scalars_array(values, "values");
      const FloatArray rows = points_array(positions, "positions");
      require_rows(numbers, "values", rows.shape(0), "positions");
    }
    return pixels_to_numpy(draw(positions, [&](PointsView x) {
      return with_open([&](auto& renderer) {
        return renderer.render(x, camera, params, all, scalars_view(numbers));
      });
    }));
  }

  void set_environment_map(const py::object& map) {
    std::optional<EnvironmentMap> pixels;
    if (!map.is_none()) pixels = environment_map(map);
    with_lock([&] { with_open([&](auto& renderer) { renderer.set_environment_map(pixels); }); });
  }

  py::dict layers(py::handle positions, const Camera& camera, const RenderParams& params) {
    Layers layers = draw(positions, [&](PointsView x) {
      return with_open([&](auto& renderer) { return renderer.layers(x, camera, params); });
    });
    py::dict result;
    const auto give = [&](const char* name, Pixels<float>& layer) {
      if (!layer.data.empty()) result[name] = pixels_to_numpy(std::move(layer));
    };
    give("depth", layers.depth);
    give("depth_smooth", layers.depth_smooth);
    give("thickness", layers.thickness);
    give("thickness_smooth", layers.thickness_smooth);
    give("normal", layers.normal);
    return result;
  }

  py::dict report() {
    py::dict milliseconds;
    const RenderReport report = with_lock([&] { return last_report(); });
    for (const auto& [name, time] : report.milliseconds) milliseconds[name.c_str()] = time;
    return py::dict("particles"_a = report.particles, "milliseconds"_a = milliseconds);
  }

  [[nodiscard]] py::dict info() const {
    return py::dict("renderer"_a = info_.renderer, "vendor"_a = info_.vendor,
                    "version"_a = info_.version, "platform"_a = info_.platform,
                    "choice"_a = info_.choice);
  }
  [[nodiscard]] std::string description() const { return description_; }
  [[nodiscard]] bool software() const { return info_.software; }
  [[nodiscard]] bool asked_for() const { return info_.asked_for; }
  [[nodiscard]] std::string missing() const { return missing_; }
  [[nodiscard]] std::vector<std::string> attempts() const { return info_.attempts; }
  void close() {
    if (getpid() != process_) {
      static_cast<void>(renderer_.release());  // its names are the parent's
      cpu_.reset();
      return;
    }
    with_lock([&] {
      renderer_.reset();
      cpu_.reset();
    });
  }
  bool closed() {
    if (getpid() != process_) return renderer_ == nullptr && cpu_ == nullptr;
    return with_lock([&] { return renderer_ == nullptr && cpu_ == nullptr; });
  }
};

py::array_t<std::uint8_t> colors_by_params(const py::object& values, const RenderParams& params) {
  const FloatArray array = scalars_array(values, "values");
  const auto view = scalars_view(array);
  const Colors colors =
      colors_of(view, params.colormap, params.color_range.value_or(range_of(view)));
  py::array_t<std::uint8_t> result({static_cast<py::ssize_t>(colors.size()), py::ssize_t{3}});
  auto rows = result.mutable_unchecked<2>();
  for (std::size_t i = 0; i < colors.size(); ++i) {
    for (int k = 0; k < 3; ++k) {
      rows(static_cast<py::ssize_t>(i), k) = static_cast<std::uint8_t>(colors[i] >> (16 - 8 * k));
    }
  }
  return result;
}

std::pair<std::vector<std::pair<double, std::string>>, int> legend_ticks(double low, double high) {
  const Ticks ticks = ticks_of({static_cast<Real>(low), static_cast<Real>(high)});
  std::vector<std::pair<double, std::string>> result;
  for (const auto& [value, text] : ticks.ticks) result.emplace_back(value, text);
  return {result, ticks.exponent};
}

}  // namespace

void register_render(py::module_& m) {
  bind_params<Camera>(m, "Where the picture is taken from.");
  bind_params<RenderParams>(m, "How the fluid is drawn. SI units; colors are linear, 0 to 1.");
  m.def("colors", &colors_by_params, "values"_a, "params"_a);
  m.def("legend_ticks", &legend_ticks, "low"_a, "high"_a,
        "Value and text of each, and the power of ten that the texts leave out.");
  py::class_<Mesh, std::shared_ptr<Mesh>>(m, "Mesh",
                                          R"(An opaque thing in the scene, of one color.

Triangles are counter-clockwise seen from outside, and not seen from inside; each is lit as the flat
thing it is. Arrays of other libraries do, as in ``Mesh(mesh.vertices, mesh.faces)`` for one of
trimesh.

Parameters
----------
vertices : array_like, shape (n, 3), float32
    Corners [m].
faces : array_like, shape (m, 3), integers
    The vertices of each triangle, counted from 0.
color : three numbers, optional
    Red, green and blue, linear, 0 to 1.

Raises
------
InvalidParameter
    If a shape is another, a vertex is not finite, a face names a vertex that is not there, or a
    color is out of range.
WrongType
    If the arrays are no real or whole numbers.
)")
      .def(py::init(&make_mesh), "vertices"_a, "faces"_a,
           "color"_a = std::array<double, 3>{0.6, 0.6, 0.6})
      .def_property_readonly(
          "vertices", [](const Mesh& self) { return points_to_numpy(Points(self.vertices())); })
      .def_property_readonly(
          "faces",
          [](const Mesh& self) {
            py::array_t<std::int64_t> faces(
                {static_cast<py::ssize_t>(self.triangles().size()), static_cast<py::ssize_t>(3)});
            if (!self.triangles().empty()) {
              std::copy_n(self.triangles()[0].data(), faces.size(), faces.mutable_data());
            }
            return faces;
          })
      .def_property_readonly("color",
                             [](const Mesh& self) { return PythonForm<Vec3>::out(self.color()); });
  py::class_<Renderer>(m, "Renderer", "Draws particles as a fluid, without a screen.")
      .def(py::init<int, int, std::string, bool, const std::optional<std::string>&>(), "width"_a,
           "height"_a, "device"_a = "", "timed"_a = false, "backend"_a = py::none())
      .def("render", &Renderer::render, "positions"_a, "camera"_a, "params"_a, "meshes"_a,
           "values"_a = py::none())
      .def("set_environment_map", &Renderer::set_environment_map, "environment_map"_a)
      .def("layers", &Renderer::layers, "positions"_a, "camera"_a, "params"_a)
      .def("close", &Renderer::close)
      .def_property_readonly("closed", &Renderer::closed)
      .def_property_readonly("description", &Renderer::description)
      .def_property_readonly("info", &Renderer::info)
      .def_property_readonly("software", &Renderer::software)
      .def_property_readonly("asked_for", &Renderer::asked_for)
      .def_property_readonly("attempts", &Renderer::attempts)
      .def_property_readonly("missing", &Renderer::missing)
      .def_property_readonly("report", &Renderer::report);
  m.def("egl_devices", &egl_device_dicts, "Devices that EGL lists.");
  m.def("egl_cures", &egl_cures, "What to do where rendering, or a GPU for it, is missing.");
  m.def("visible_gpus", &visible_gpus, "Device files of GPUs, usable or not.");
}

}  // namespace pbf
