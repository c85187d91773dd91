#pragma once

#include "pbf/core/types.hpp"
#include "pbf/gl/handle.hpp"

#include <functional>
#include <map>
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

/// Programs of the same files with different defines, each compiled when it is first asked for. A
/// software rasterizer works off both branches of a condition, so that what a picture does not need
/// is better left out of its program.
class ProgramVariants {
 public:
  ProgramVariants(GlslSource source, ProgramFiles files)
      : source_(std::move(source)), files_(std::move(files)) {}
  const Program& with(const std::vector<std::string>& defines);

 private:
  GlslSource source_;
  ProgramFiles files_;
  std::map<std::vector<std::string>, Program> programs_;
};

}  // namespace pbf
