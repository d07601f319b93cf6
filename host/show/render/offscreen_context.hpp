#pragma once

namespace verp::render {

/// An OpenGL context without a window or display (EGL's surfaceless platform). The constructor
/// makes it current in its thread.
class OffscreenContext {
 public:
  /// Throws RenderError if no driver supports it.
  OffscreenContext();
  ~OffscreenContext();
  OffscreenContext(const OffscreenContext&) = delete;
  OffscreenContext& operator=(const OffscreenContext&) = delete;

  void make_current();

 private:
  void* display_ = nullptr;
  void* context_ = nullptr;
};

}  // namespace verp::render
