#pragma once

namespace verp::render {

/// An OpenGL context without a window or display: EGL's surfaceless platform, current in this
/// thread from the constructor on.
class OffscreenContext {
 public:
  /// Throws RenderError when there is no driver for it.
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
