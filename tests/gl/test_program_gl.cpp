#include "pbf/core/error.hpp"
#include "pbf/gl/program.hpp"

#include "gl_fixture.hpp"

using namespace pbf;
using namespace pbf::test;

TEST_CASE("program: an error names the file and the line and shows it") {
  const GlFixture gl;
  const auto source = [](std::string_view name) -> std::string {
    if (name == "good.vert") return "void main() { gl_Position = vec4(0.0); }\n";
    if (name == "shared.glsl") return "float one() { return 1.0; }\n";
    return "// two lines\n// above\nout vec4 o;\nvoid main() { o = vec4(one() + nowhere); }\n";
  };
  const ProgramFiles files{
      .vertex = {"good.vert"}, .fragment = {"shared.glsl", "bad.frag"}, .defines = {}};
  std::string message;
  try {
    const Program program(source, files);
  } catch (const GlError& error) {
    message = error.what();
  }
  CAPTURE(message);
  CHECK(message.find("bad.frag:4:") == 0);
  CHECK(message.find("o = vec4(one() + nowhere)") != std::string::npos);
  CHECK(message.find("nowhere") != std::string::npos);
}

TEST_CASE("program: a shader that is not there is named") {
  CHECK_THROWS_WITH_AS(glsl_source("fog.frag"), "no shader file is called fog.frag", GlError);
}
