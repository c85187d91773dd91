#include "pbf/gl/egl_context.hpp"

#include "pbf/core/error.hpp"
#include "pbf/gl/egl_cures.hpp"
#include "pbf/gl/egl_display.hpp"
#include "pbf/gl/egl_turn.hpp"
#include "pbf/gl/functions.hpp"
#include "pbf/gl/software_threads.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <unistd.h>

namespace pbf {
namespace {

struct Version {
  EGLint major, minor;
};
constexpr std::array kVersions{Version{4, 5}, Version{4, 3}, Version{4, 1}, Version{3, 3}};

#ifdef NDEBUG
constexpr EGLint kDebugContext = 0;
#else
constexpr EGLint kDebugContext = 1;

void report_gl_error(GLenum /*source*/,
                     GLenum type,
                     GLuint /*id*/,
                     GLenum /*severity*/,
                     GLsizei /*length*/,
                     const char* message,
                     const void* /*user*/) {
  if (type == GL_DEBUG_TYPE_ERROR) std::fprintf(stderr, "OpenGL error: %s\n", message);
}
#endif

/// Null if no version is offered; eglGetError then knows about the last.
EGLContext create_core_context(EGLDisplay display, EGLConfig config) {
  for (const Version version : kVersions) {
    const std::array<EGLint, 9> attributes{EGL_CONTEXT_MAJOR_VERSION,
                                           version.major,
                                           EGL_CONTEXT_MINOR_VERSION,
                                           version.minor,
                                           EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                           EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                           kDebugContext == 1 ? EGL_CONTEXT_OPENGL_DEBUG : EGL_NONE,
                                           kDebugContext,
                                           EGL_NONE};
    EGLContext context = eglCreateContext(display, config, nullptr, attributes.data());
    if (context != nullptr) return context;
  }
  return nullptr;
}

/// A configuration is needed only where contexts do not work without one.
EGLConfig pbuffer_config(EGLDisplay display) {
  const std::array<EGLint, 5> wanted{EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE,
                                     EGL_OPENGL_BIT, EGL_NONE};
  EGLConfig config = nullptr;
  EGLint count = 0;
  eglChooseConfig(display, wanted.data(), &config, 1, &count);
  return count > 0 ? config : nullptr;
}

std::string gl_string(GLenum name) {
  const unsigned char* text = glGetString(name);
  return text != nullptr ? reinterpret_cast<const char*>(text) : "unknown";
}

std::string failure(const std::vector<std::string>& attempts) {
  std::string text = "no OpenGL context could be made; tried in this order:";
  for (const std::string& attempt : attempts) text += "\n  " + attempt;
  text += "\nCure, whichever fits:";
  for (const std::string& cure : egl_cures()) text += "\n  " + cure;
  return text;
}

/// Why a platform was taken, the first of its kind that works.
std::string reason(const DeviceWish& wish, const EglPlatform& platform, bool hardware_failed) {
  if (!wish.source.empty()) return "asked for by " + wish.source;
  if (platform.device.handle == nullptr) return "no EGL device works";
  if (platform.device.cuda) return "the first GPU of CUDA that works";
  if (!platform.device.software) return "the first hardware device that works";
  return hardware_failed ? "no hardware device works" : "EGL lists no hardware device";
}

bool is_software(const std::string& renderer) {
  constexpr std::array names{"llvmpipe", "softpipe", "swrast", "SwiftShader", "Software"};
  return std::any_of(names.begin(), names.end(),
                     [&](const char* name) { return renderer.find(name) != std::string::npos; });
}

/// OpenGL rather than OpenGL ES is meant while it lives; the choice is the thread's.
class OpenGlApi {
 public:
  OpenGlApi() : before_(eglQueryAPI()), ok_(eglBindAPI(EGL_OPENGL_API) != 0) {}
  ~OpenGlApi() { eglBindAPI(before_); }
  OpenGlApi(const OpenGlApi&) = delete;
  OpenGlApi& operator=(const OpenGlApi&) = delete;
  [[nodiscard]] bool ok() const { return ok_; }

 private:
  EGLenum before_;
  bool ok_;
};

}  // namespace

EglContext::EglContext(const std::string& device) : process_(getpid()) {
  const EglTurn turn;
  create(device);
  try {
    const Current current(*this);
    load_gl_functions();
    ask_driver();
  } catch (...) {
    eglDestroyContext(display_, context_);
    if (surface_ != nullptr) eglDestroySurface(display_, surface_);
    throw;
  }
}

void EglContext::create(const std::string& device) {
  const SoftwareThreads threads;
  const DeviceWish wish = device_wish(device);
  bool hardware_failed = false;
  std::vector<std::string>& attempts = info_.attempts;
  for (const EglPlatform& platform : egl_platforms(wish, attempts)) {
    const auto note = [&](const char* what) {
      attempts.push_back(platform.name + ": " + what + ": " + egl_error_text());
      hardware_failed |= platform.device.handle != nullptr && !platform.device.software;
    };
    display_ = open_display(platform);
    if (display_ == nullptr) {
      note("the display cannot be opened");
      continue;
    }
    const OpenGlApi api;
    if (!api.ok()) {
      note("desktop OpenGL is not offered");
      continue;
    }
    const char* extensions = eglQueryString(display_, EGL_EXTENSIONS);
    const bool needs_surface = !has_extension(extensions, "EGL_KHR_surfaceless_context");
    const bool needs_config =
        needs_surface || !has_extension(extensions, "EGL_KHR_no_config_context");
    EGLConfig config = needs_config ? pbuffer_config(display_) : nullptr;
    if (needs_config && config == nullptr) {
      note("no configuration for off-screen drawing");
      continue;
    }
    context_ = create_core_context(display_, config);
    if (context_ == nullptr) {
      note("no OpenGL core context of version 3.3 or newer");
      continue;
    }
    if (needs_surface) {
      const std::array<EGLint, 5> size{EGL_WIDTH, 1, EGL_HEIGHT, 1, EGL_NONE};
      surface_ = eglCreatePbufferSurface(display_, config, size.data());
      if (surface_ == nullptr) {
        note("no surface for off-screen drawing");
        eglDestroyContext(display_, context_);
        continue;
      }
    }
    info_.platform = platform.name;
    info_.choice = reason(wish, platform, hardware_failed);
    info_.asked_for = !wish.source.empty();
    info_.software = platform.device.software;
    return;
  }
  throw RendererUnavailable(failure(attempts));
}

void EglContext::ask_driver() {
  info_.renderer = gl_string(GL_RENDERER);
  info_.vendor = gl_string(GL_VENDOR);
  info_.version = gl_string(GL_VERSION);
  info_.software = info_.software || is_software(info_.renderer);
  glGetIntegerv(GL_MAJOR_VERSION, &info_.major);
  glGetIntegerv(GL_MINOR_VERSION, &info_.minor);
#ifndef NDEBUG
  if (has_version(4, 3)) {
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    glDebugMessageCallback(report_gl_error, nullptr);
  }
#endif
}

EglContext::~EglContext() {
  if (getpid() != process_) return;
  eglDestroyContext(display_, context_);
  if (surface_ != nullptr) eglDestroySurface(display_, surface_);
}

bool EglContext::has_version(int major, int minor) const {
  return info_.major > major || (info_.major == major && info_.minor >= minor);
}

std::string EglContext::description() const {
  return info_.renderer + ", OpenGL " + std::to_string(info_.major) + "." +
         std::to_string(info_.minor) + ", " + info_.platform;
}

EglContext::Current::Current(const EglContext& context) : own_display_(context.display_) {
  require_process(context.process_);
  api_ = eglQueryAPI();
  eglBindAPI(EGL_OPENGL_API);
  display_ = eglGetCurrentDisplay();
  draw_ = eglGetCurrentSurface(EGL_DRAW);
  read_ = eglGetCurrentSurface(EGL_READ);
  context_ = eglGetCurrentContext();
  if (eglMakeCurrent(own_display_, context.surface_, context.surface_, context.context_) == 0) {
    const std::string error = egl_error_text();
    // A failure across drivers may have taken away what was current before.
    if (context_ != nullptr) eglMakeCurrent(display_, draw_, read_, context_);
    eglBindAPI(api_);
    throw GlError("the OpenGL context cannot be made current: " + error);
  }
}

EglContext::Current::~Current() {
  // What was current may have been destroyed meanwhile; then nothing is.
  if (context_ == nullptr || eglMakeCurrent(display_, draw_, read_, context_) == 0) {
    eglMakeCurrent(own_display_, nullptr, nullptr, nullptr);
  }
  eglBindAPI(api_);
}

}  // namespace pbf
