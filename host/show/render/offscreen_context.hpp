#pragma once

namespace verp::render {

/// A context without window or display (EGL surfaceless), current in the constructor's thread.
class OffscreenContext {
 public:
  /// Throws RenderError without a driver.
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
