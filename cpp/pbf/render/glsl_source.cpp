#include "pbf/render/glsl_source.hpp"

#include "pbf/core/error.hpp"

#include <cstdlib>
#include <fstream>
#include <sstream>

namespace pbf {

std::string glsl_source(std::string_view name) {
  if (const char* folder = std::getenv("PBF_GLSL_DIR"); folder != nullptr && *folder != '\0') {
    const std::string path = std::string(folder) + "/" + std::string(name);
    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    if (!file || !(text << file.rdbuf())) {
      throw GlError("PBF_GLSL_DIR = " + std::string(folder) + ": " + path +
                    " cannot be read; it must be a copy of the folder glsl/");
    }
    return text.str();
  }
  for (const GlslFile& file : embedded_glsl()) {
    if (file.name == name) return file.text;
  }
  throw GlError("no shader file is called " + std::string(name));
}

}  // namespace pbf
