#pragma once

#include <cstddef>
#include <cstdint>

/// EGL and OpenGL as this library uses them: types, constants and calls, declared here so that no
/// system header is needed, and found at run time so that nothing is linked. The names are
/// Khronos'.
// NOLINTBEGIN(readability-identifier-naming)
namespace pbf {

using EGLBoolean = unsigned int;
using EGLint = std::int32_t;
using EGLAttrib = std::intptr_t;
using EGLenum = unsigned int;
using EGLDisplay = void*;
using EGLContext = void*;
using EGLConfig = void*;
using EGLSurface = void*;
using EGLDevice = void*;

using GLenum = unsigned int;
using GLuint = unsigned int;
using GLint = int;
using GLsizei = int;
using GLbitfield = unsigned int;
using GLfloat = float;
using GLboolean = unsigned char;
using GLsizeiptr = std::ptrdiff_t;

using AnyFunction = void (*)();
using DebugCallback = void (*)(GLenum source,
                               GLenum type,
                               GLuint id,
                               GLenum severity,
                               GLsizei length,
                               const char* message,
                               const void* user);

inline constexpr EGLenum EGL_OPENGL_API = 0x30A2;
inline constexpr EGLenum EGL_PLATFORM_DEVICE_EXT = 0x313F;
inline constexpr EGLenum EGL_PLATFORM_SURFACELESS_MESA = 0x31DD;
inline constexpr EGLint EGL_SUCCESS = 0x3000;
inline constexpr EGLint EGL_PBUFFER_BIT = 0x0001;
inline constexpr EGLint EGL_OPENGL_BIT = 0x0008;
inline constexpr EGLint EGL_SURFACE_TYPE = 0x3033;
inline constexpr EGLint EGL_NONE = 0x3038;
inline constexpr EGLint EGL_RENDERABLE_TYPE = 0x3040;
inline constexpr EGLint EGL_EXTENSIONS = 0x3055;
inline constexpr EGLint EGL_HEIGHT = 0x3056;
inline constexpr EGLint EGL_WIDTH = 0x3057;
inline constexpr EGLint EGL_DRAW = 0x3059;
inline constexpr EGLint EGL_READ = 0x305A;
inline constexpr EGLint EGL_CONTEXT_MAJOR_VERSION = 0x3098;
inline constexpr EGLint EGL_CONTEXT_MINOR_VERSION = 0x30FB;
inline constexpr EGLint EGL_CONTEXT_OPENGL_PROFILE_MASK = 0x30FD;
inline constexpr EGLint EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT = 0x1;
inline constexpr EGLint EGL_CONTEXT_OPENGL_DEBUG = 0x31B0;
inline constexpr EGLint EGL_DRM_DEVICE_FILE_EXT = 0x3233;
inline constexpr EGLint EGL_CUDA_DEVICE_NV = 0x323A;
inline constexpr EGLint EGL_DRM_RENDER_NODE_FILE_EXT = 0x3377;

inline constexpr GLenum GL_NO_ERROR = 0;
inline constexpr GLenum GL_ZERO = 0;
inline constexpr GLenum GL_ONE = 1;
inline constexpr GLenum GL_POINTS = 0x0000;
inline constexpr GLenum GL_TRIANGLES = 0x0004;
inline constexpr GLenum GL_TRIANGLE_STRIP = 0x0005;
inline constexpr GLenum GL_GREATER = 0x0204;
inline constexpr GLenum GL_ONE_MINUS_SRC_ALPHA = 0x0303;
inline constexpr GLenum GL_BACK = 0x0405;
inline constexpr GLenum GL_OUT_OF_MEMORY = 0x0505;
inline constexpr GLenum GL_CULL_FACE = 0x0B44;
inline constexpr GLenum GL_DEPTH_TEST = 0x0B71;
inline constexpr GLenum GL_BLEND = 0x0BE2;
inline constexpr GLenum GL_UNPACK_ALIGNMENT = 0x0CF5;
inline constexpr GLenum GL_PACK_ALIGNMENT = 0x0D05;
inline constexpr GLenum GL_UNPACK_ROW_LENGTH = 0x0CF2;
inline constexpr GLenum GL_MAX_TEXTURE_SIZE = 0x0D33;
inline constexpr GLenum GL_TEXTURE_2D = 0x0DE1;
inline constexpr GLenum GL_UNSIGNED_BYTE = 0x1401;
inline constexpr GLenum GL_FLOAT = 0x1406;
inline constexpr GLenum GL_COLOR = 0x1800;
inline constexpr GLenum GL_DEPTH = 0x1801;
inline constexpr GLenum GL_DEPTH_COMPONENT = 0x1902;
inline constexpr GLenum GL_RED = 0x1903;
inline constexpr GLenum GL_RGB = 0x1907;
inline constexpr GLenum GL_RGBA = 0x1908;
inline constexpr GLenum GL_VENDOR = 0x1F00;
inline constexpr GLenum GL_RENDERER = 0x1F01;
inline constexpr GLenum GL_VERSION = 0x1F02;
inline constexpr GLint GL_NEAREST = 0x2600;
inline constexpr GLint GL_LINEAR = 0x2601;
inline constexpr GLint GL_LINEAR_MIPMAP_LINEAR = 0x2703;
inline constexpr GLenum GL_TEXTURE_MAG_FILTER = 0x2800;
inline constexpr GLenum GL_TEXTURE_MIN_FILTER = 0x2801;
inline constexpr GLenum GL_TEXTURE_WRAP_S = 0x2802;
inline constexpr GLenum GL_TEXTURE_WRAP_T = 0x2803;
inline constexpr GLenum GL_FUNC_ADD = 0x8006;
inline constexpr GLenum GL_MIN = 0x8007;
inline constexpr GLenum GL_MAX = 0x8008;
inline constexpr GLenum GL_RGBA8 = 0x8058;
inline constexpr GLint GL_REPEAT = 0x2901;
inline constexpr GLint GL_CLAMP_TO_EDGE = 0x812F;
inline constexpr GLenum GL_TEXTURE_MAX_LEVEL = 0x813D;
inline constexpr GLenum GL_MAJOR_VERSION = 0x821B;
inline constexpr GLenum GL_MINOR_VERSION = 0x821C;
inline constexpr GLenum GL_R32F = 0x822E;
inline constexpr GLenum GL_DEBUG_OUTPUT_SYNCHRONOUS = 0x8242;
inline constexpr GLenum GL_DEBUG_TYPE_ERROR = 0x824C;
inline constexpr GLenum GL_TEXTURE0 = 0x84C0;
inline constexpr GLenum GL_PROGRAM_POINT_SIZE = 0x8642;
inline constexpr GLenum GL_RGBA32F = 0x8814;
inline constexpr GLenum GL_RGBA16F = 0x881A;
inline constexpr GLenum GL_SRGB8_ALPHA8 = 0x8C43;
inline constexpr GLenum GL_ARRAY_BUFFER = 0x8892;
inline constexpr GLenum GL_STREAM_DRAW = 0x88E0;
inline constexpr GLenum GL_UNIFORM_BUFFER = 0x8A11;
inline constexpr GLenum GL_FRAGMENT_SHADER = 0x8B30;
inline constexpr GLenum GL_VERTEX_SHADER = 0x8B31;
inline constexpr GLenum GL_COMPILE_STATUS = 0x8B81;
inline constexpr GLenum GL_LINK_STATUS = 0x8B82;
inline constexpr GLenum GL_INFO_LOG_LENGTH = 0x8B84;
inline constexpr GLenum GL_DEPTH_COMPONENT32F = 0x8CAC;
inline constexpr GLenum GL_FRAMEBUFFER_COMPLETE = 0x8CD5;
inline constexpr GLenum GL_COLOR_ATTACHMENT0 = 0x8CE0;
inline constexpr GLenum GL_DEPTH_ATTACHMENT = 0x8D00;
inline constexpr GLenum GL_FRAMEBUFFER = 0x8D40;
inline constexpr GLenum GL_READ_FRAMEBUFFER = 0x8CA8;
inline constexpr GLenum GL_DRAW_FRAMEBUFFER = 0x8CA9;
inline constexpr GLbitfield GL_COLOR_BUFFER_BIT = 0x4000;
inline constexpr GLenum GL_FRAMEBUFFER_SRGB = 0x8DB9;
inline constexpr GLenum GL_DEBUG_OUTPUT = 0x92E0;

#define PBF_DECLARE(result, name, arguments) extern result(*name) arguments;
#define PBF_EGL PBF_DECLARE
#define PBF_EGL_OPTIONAL PBF_DECLARE
#define PBF_GL PBF_DECLARE
#define PBF_GL_OPTIONAL PBF_DECLARE
#include "pbf/gl/functions.inl"
#undef PBF_EGL
#undef PBF_EGL_OPTIONAL
#undef PBF_GL
#undef PBF_GL_OPTIONAL
#undef PBF_DECLARE

/// Opens libEGL at the first call. Throws RendererUnavailable if there is none. Not thread-safe:
/// the caller has an EglTurn.
void load_egl_functions();

/// Looks up the OpenGL calls at the first call; needs the EGL calls. Throws RendererUnavailable for
/// one that is missing. EGL gives the same address for every context, so the table is the
/// process's.
void load_gl_functions();

}  // namespace pbf
// NOLINTEND(readability-identifier-naming)
