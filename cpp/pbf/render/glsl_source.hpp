#pragma once

#include <span>
#include <string>
#include <string_view>

namespace pbf {

struct GlslFile {
  const char* name;
  const char* text;
};

/// The files of glsl/ as they were at build time.
std::span<const GlslFile> embedded_glsl();

/// The text of a file of glsl/: from the folder that the environment variable PBF_GLSL_DIR names,
/// so that a shader can be edited without building, or else as it was at build time. Throws
/// GlError.
std::string glsl_source(std::string_view name);

}  // namespace pbf
