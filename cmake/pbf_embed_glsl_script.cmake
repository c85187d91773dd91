# Writes OUTPUT, a C++ file that holds each of FILES as an array of characters. Read as hexadecimal
# pairs, since CMake would take semicolons and brackets in the text for lists.
set(entries "")
foreach(path IN LISTS FILES)
  get_filename_component(name "${path}" NAME)
  file(READ "${path}" bytes HEX)
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "'\\\\x\\1'," bytes "${bytes}")
  string(REGEX REPLACE "(('..x[0-9a-f][0-9a-f]',){16})" "\\1\n" bytes "${bytes}")
  string(MAKE_C_IDENTIFIER "${name}" identifier)
  string(APPEND arrays "constexpr char ${identifier}[] = {\n${bytes}'\\0'};\n")
  string(APPEND entries "    {\"${name}\", ${identifier}},\n")
endforeach()
file(WRITE "${OUTPUT}" "// Generated from glsl/ at build time. NOLINTBEGIN
#include \"pbf/render/glsl_source.hpp\"

namespace pbf {
namespace {
${arrays}
constexpr GlslFile kFiles[] = {
${entries}};
}  // namespace

std::span<const GlslFile> embedded_glsl() { return kFiles; }

}  // namespace pbf
// NOLINTEND
")
