#pragma once

#include <stdexcept>
#include <string>

namespace pbf {

/// Base of everything the library throws on purpose. A message says field, value, limit and remedy.
/// A call that throws has changed nothing.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A value, a shape or a file's content breaks a rule.
class InvalidParameter : public Error {
 public:
  using Error::Error;
};

/// A step could not be completed (for example: positions stopped being finite). The state is that
/// of the last complete step.
class SimulationFailed : public Error {
 public:
  using Error::Error;
};

/// No OpenGL context can be had on this machine; the message lists every attempt and the cure.
class RendererUnavailable : public Error {
 public:
  using Error::Error;
};

/// A shader does not compile, or the driver reports an error.
class GlError : public Error {
 public:
  using Error::Error;
};

}  // namespace pbf
