#include "pbf/gl/program.hpp"

#include "pbf/core/error.hpp"

#include <algorithm>
#include <cctype>
#include <optional>
#include <sstream>

namespace pbf {
namespace {

class ShaderObject {
 public:
  explicit ShaderObject(GLenum type) : name_(glCreateShader(type)) {}
  ~ShaderObject() { glDeleteShader(name_); }
  ShaderObject(const ShaderObject&) = delete;
  ShaderObject& operator=(const ShaderObject&) = delete;
  [[nodiscard]] GLuint name() const { return name_; }

 private:
  GLuint name_;
};

std::string nth_line(const std::string& text, int number) {
  std::istringstream lines(text);
  std::string line;
  for (int k = 0; k < number; ++k) std::getline(lines, line);
  return line;
}

template <class Get, class GetLog>
std::string info_log(GLuint name, Get get, GetLog get_log) {
  GLint length = 0;
  get(name, GL_INFO_LOG_LENGTH, &length);
  std::string log(static_cast<std::size_t>(std::max(length, 1)), '\0');
  get_log(name, length, nullptr, log.data());
  while (!log.empty() && (log.back() == '\0' || log.back() == '\n')) log.pop_back();
  return log;
}

/// File k of a stage has the lines from k * kFileLines on: `#line` could number files as well, but
/// Mesa loses that number.
constexpr int kFileLines = 10'000;

bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

/// The line of the first complaint: behind a number and a colon or parenthesis. Drivers write
/// `0:23(5): …` (Mesa), `0(23) : …` (NVIDIA) or `ERROR: 0:23: …`.
std::optional<int> line_of(const std::string& log) {
  for (std::size_t k = 1; k + 1 < log.size(); ++k) {
    const bool behind_number = is_digit(log[k - 1]) && (log[k] == ':' || log[k] == '(');
    if (behind_number && is_digit(log[k + 1])) return std::stoi(log.substr(k + 1, 9));
  }
  return std::nullopt;
}

/// `text` with the number `from` replaced where it stands whole.
std::string with_number(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at)) {
    const std::size_t end = at + from.size();
    const bool whole =
        (at == 0 || !is_digit(text[at - 1])) && (end == text.size() || !is_digit(text[end]));
    if (whole) text.replace(at, from.size(), to);
    at += whole ? to.size() : from.size();
  }
  return text;
}

std::string located(const std::string& log,
                    const std::vector<std::string>& names,
                    const std::vector<std::string>& texts) {
  const std::optional<int> number = line_of(log);
  const auto file = static_cast<std::size_t>(number.value_or(0) / kFileLines);
  if (!number || file >= names.size()) return names.back() + ": " + log;
  const std::string line = std::to_string(*number % kFileLines);
  return names[file] + ":" + line + ": does not compile\n  " + line + " | " +
         nth_line(texts[file], *number % kFileLines) + "\n" +
         with_number(log, std::to_string(*number), line);
}

void compile(const ShaderObject& shader,
             const GlslSource& source,
             const std::vector<std::string>& names,
             const std::vector<std::string>& defines) {
  std::string text = "#version 330 core\n";
  for (const std::string& define : defines) text += "#define " + define + "\n";
  std::vector<std::string> texts;
  for (const std::string& name : names) {
    text += "#line " + std::to_string(static_cast<int>(texts.size()) * kFileLines + 1) + "\n";
    texts.push_back(source(name));
    text += texts.back() + "\n";
  }
  const char* pointer = text.c_str();
  glShaderSource(shader.name(), 1, &pointer, nullptr);
  glCompileShader(shader.name());
  GLint ok = 0;
  glGetShaderiv(shader.name(), GL_COMPILE_STATUS, &ok);
  if (ok == 0) {
    throw GlError(
        located(info_log(shader.name(), glGetShaderiv, glGetShaderInfoLog), names, texts));
  }
}

}  // namespace

Program::Program(const GlslSource& source, const ProgramFiles& files) {
  const ShaderObject vertex(GL_VERTEX_SHADER);
  const ShaderObject fragment(GL_FRAGMENT_SHADER);
  compile(vertex, source, files.vertex, files.defines);
  compile(fragment, source, files.fragment, files.defines);
  glAttachShader(handle_.name(), vertex.name());
  glAttachShader(handle_.name(), fragment.name());
  glBindAttribLocation(handle_.name(), 0, "a_position");
  glLinkProgram(handle_.name());
  GLint ok = 0;
  glGetProgramiv(handle_.name(), GL_LINK_STATUS, &ok);
  if (ok == 0) {
    throw GlError(files.vertex.back() + " and " + files.fragment.back() + " do not link\n" +
                  info_log(handle_.name(), glGetProgramiv, glGetProgramInfoLog));
  }
  const GLuint frame = glGetUniformBlockIndex(handle_.name(), "Frame");
  if (frame != ~0U) glUniformBlockBinding(handle_.name(), frame, 0);
}

GLint Program::location(const char* name) const {
  return glGetUniformLocation(handle_.name(), name);
}
void Program::set(const char* name, float value) const { glUniform1f(location(name), value); }
void Program::set(const char* name, int value) const { glUniform1i(location(name), value); }
void Program::set(const char* name, int x, int y) const { glUniform2i(location(name), x, y); }
void Program::set(const char* name, const Vec3& value) const {
  glUniform3f(location(name), value.x(), value.y(), value.z());
}

const Program& ProgramVariants::with(const std::vector<std::string>& defines) {
  auto found = programs_.find(defines);
  if (found == programs_.end()) {
    ProgramFiles files = files_;
    files.defines.insert(files.defines.end(), defines.begin(), defines.end());
    found = programs_.try_emplace(defines, source_, files).first;
  }
  return found->second;
}

}  // namespace pbf
