#include "pbf/core/error.hpp"

#include "common.hpp"
#include <new>
#include <string>

namespace pbf {
namespace {

void set_error(const char* error_class, const char* message) {
  py::set_error(py::module_::import("pbfluids.errors").attr(error_class), message);
}

}  // namespace

void raise(const char* error_class, const std::string& message) {
  set_error(error_class, message.c_str());
  throw py::error_already_set();
}

/// C++ errors become the Python classes of pbfluids.errors, most derived first.
void register_errors(py::module_& /*m*/) {
  py::register_local_exception_translator([](std::exception_ptr error) {
    try {
      if (error) std::rethrow_exception(error);
    } catch (const InvalidParameter& e) {
      set_error("InvalidParameter", e.what());
    } catch (const SimulationFailed& e) {
      set_error("SimulationFailed", e.what());
    } catch (const RendererUnavailable& e) {
      set_error("RendererUnavailable", e.what());
    } catch (const GlError& e) {
      set_error("GlError", e.what());
    } catch (const Error& e) {
      set_error("FluidError", e.what());
    } catch (const std::bad_alloc&) {
      set_error("OutOfMemory", "not enough memory: use fewer particles or a smaller image");
    } catch (const std::length_error&) {
      set_error("OutOfMemory",
                "an array would be larger than can be addressed: use fewer particles");
    }
  });
}

}  // namespace pbf
