#pragma once

#include <string>
#include <vector>

namespace pbf {

/// A headless OpenGL core context, 3.3 or newer. Platforms are tried in order: EGL devices, those
/// that CUDA uses first, other hardware, software, then Mesa's surfaceless platform; see
/// device_wish() for how to ask for one of them. eglTerminate is never called: it would take the
/// display from every other context too.
///
/// The context is current only while a Current lives, so any thread may use it, one at a time.
/// After fork() the child can use neither it nor EGL, since the driver's threads stayed in the
/// parent: every call says so instead of hanging.
class EglContext {
 public:
  /// @param device  as for device_wish(); empty leaves the choice open
  /// Throws InvalidParameter if it means nothing, RendererUnavailable with every attempt, what it
  /// failed with and the cure.
  explicit EglContext(const std::string& device = "");
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
    std::string choice;    ///< why this platform: "the first hardware device that works"
    std::string renderer, vendor, version;
    int major = 0, minor = 0;
    bool software = false;              ///< the processor draws
    bool asked_for = false;             ///< the user chose the device
    std::vector<std::string> attempts;  ///< platforms that failed before, and why
  };
  [[nodiscard]] const Info& info() const { return info_; }
  /// "llvmpipe (…), OpenGL 4.5, EGL device 0 (software)"
  [[nodiscard]] std::string description() const;
  /// Whether the driver offers at least this OpenGL version.
  [[nodiscard]] bool has_version(int major, int minor) const;

 private:
  void create(const std::string& device);
  void ask_driver();

  void* display_ = nullptr;
  void* surface_ = nullptr;  ///< 1x1, only where contexts cannot do without
  void* context_ = nullptr;
  int process_ = 0;
  Info info_;
};

}  // namespace pbf
