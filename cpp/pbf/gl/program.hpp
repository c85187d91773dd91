#pragma once

#include "pbf/core/types.hpp"
#include "pbf/gl/handle.hpp"

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace pbf {

/// Gives the text of a file of glsl/ by its name; throws GlError if there is none.
using GlslSource = std::function<std::string(std::string_view name)>;

/// What a program is made of. The parts of a stage are joined in order behind `#version` and the
/// defines; each keeps its own line numbers, so that an error names file and line.
struct ProgramFiles {
  std::vector<std::string> vertex;
  std::vector<std::string> fragment;
  std::vector<std::string> defines;  ///< "NAME" or "NAME value"
};

/// A linked vertex and fragment shader.
class Program {
 public:
  /// Throws GlError that names file and line, shows the line and the driver's log.
  Program(const GlslSource& source, const ProgramFiles& files);
  void use() const { glUseProgram(handle_.name()); }

  // The program must be in use. A uniform that the compiler found unused is passed over.
  void set(const char* name, float value) const;
  void set(const char* name, int value) const;
  void set(const char* name, int x, int y) const;
  void set(const char* name, const Vec3& value) const;

 private:
  [[nodiscard]] GLint location(const char* name) const;
  GlHandle<ProgramKind> handle_;
};

}  // namespace pbf
