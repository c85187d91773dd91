#pragma once

#include <string>

namespace pbf {

/// A headless OpenGL core context, 3.3 or newer. Platforms are tried in order: the EGL devices,
/// hardware first, then the surfaceless platform; the environment variable PBF_EGL_DEVICE=<index>
/// asks for one device. EGL displays are opened once per process and stay: eglTerminate would take
/// them from every other context too.
///
/// The context is current only while a Current lives, so any thread may use it, one at a time.
/// After fork() the child can use neither it nor EGL, since the driver's threads stayed in the
/// parent: every call says so instead of hanging.
class EglContext {
 public:
  /// Throws RendererUnavailable with every attempt, what it failed with and the cure.
  EglContext();
  ~EglContext();
  EglContext(const EglContext&) = delete;
  EglContext& operator=(const EglContext&) = delete;

  /// Makes the context current in this thread; its end gives the thread back what it had before.
  class Current {
   public:
    explicit Current(const EglContext& context);
    ~Current();
    Current(const Current&) = delete;
    Current& operator=(const Current&) = delete;

   private:
    void* own_display_;
    unsigned int api_;
    void *display_, *draw_, *read_, *context_;
  };
  [[nodiscard]] Current make_current() const { return Current(*this); }

  struct Info {
    std::string platform;  ///< "EGL device 0 (software)", "surfaceless"
    std::string renderer, vendor, version;
    int major = 0, minor = 0;
  };
  [[nodiscard]] const Info& info() const { return info_; }
  /// "llvmpipe (…), OpenGL 4.5, EGL device 0 (software)"
  [[nodiscard]] std::string description() const;
  /// Whether the driver offers at least this OpenGL version.
  [[nodiscard]] bool has_version(int major, int minor) const;

 private:
  void create();
  void ask_driver();
  [[nodiscard]] bool is_usable_here() const;

  void* display_ = nullptr;
  void* surface_ = nullptr;  ///< 1x1, only where contexts cannot do without
  void* context_ = nullptr;
  int process_ = 0;
  Info info_;
};

}  // namespace pbf
