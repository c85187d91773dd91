#pragma once

#include <pybind11/pybind11.h>

namespace pbf {

namespace py = pybind11;
using namespace pybind11::literals;

// One function per room, called by module.cpp in this order.
void register_errors(py::module_& m);
void register_params(py::module_& m);
void register_fluid(py::module_& m);
void register_stages(py::module_& m);
void register_operators(py::module_& m);
void register_render(py::module_& m);
void register_build(py::module_& m);

/// Lets other Python threads run while it lives. Unlike pybind11's it lets a daemon thread end that
/// comes back after the interpreter did: Python then unwinds the thread from within the destructor,
/// and one that is noexcept would end the process instead.
class WithoutGil {
 public:
  WithoutGil() : state_(PyEval_SaveThread()) {}
  ~WithoutGil() noexcept(false) { PyEval_RestoreThread(state_); }
  WithoutGil(const WithoutGil&) = delete;
  WithoutGil& operator=(const WithoutGil&) = delete;

 private:
  PyThreadState* state_;
};

/// Raises one of the classes of pbfluids.errors.
[[noreturn]] void raise(const char* error_class, const std::string& message);

}  // namespace pbf
