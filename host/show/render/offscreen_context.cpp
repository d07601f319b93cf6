#include "host/show/render/offscreen_context.hpp"

#include <dlfcn.h>
#include <epoxy/egl.h>

#include <cstdlib>

#include "host/show/render/renderer.hpp"

namespace verp::render {
namespace {

[[noreturn]] void no_driver(const char* what) {
  throw RenderError(std::string("no pictures without a GL driver: ") + what +
                    "; Debian's software driver is enough: apt-get install libgl1-mesa-dri "
                    "libegl1 libopengl0");
}

bool can_be_loaded(const char* library) {
  void* const handle = dlopen(library, RTLD_LAZY | RTLD_LOCAL);
  if (handle != nullptr) dlclose(handle);
  return handle != nullptr;
}

/// libepoxy ends the program at the first call into a missing library.
void require_libraries() {
  if (!can_be_loaded("libEGL.so.1")) no_driver("libEGL.so.1 is not there");
  if (!can_be_loaded("libOpenGL.so.0") && !can_be_loaded("libGL.so.1"))
    no_driver("neither libOpenGL.so.0 nor libGL.so.1 is there");
}

}  // namespace

OffscreenContext::OffscreenContext() {
  ::setenv("EGL_LOG_LEVEL", "fatal", 0);  // our message instead
  require_libraries();
  if (!epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless")) {
    no_driver("EGL has no surfaceless platform here");
  }
  display_ = eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA,
                                      reinterpret_cast<void*>(EGL_DEFAULT_DISPLAY), nullptr);
  if (display_ == EGL_NO_DISPLAY || eglInitialize(display_, nullptr, nullptr) != EGL_TRUE) {
    no_driver("EGL does not start");
  }
  const EGLint wanted[] = {EGL_CONTEXT_MAJOR_VERSION,
                           3,
                           EGL_CONTEXT_MINOR_VERSION,
                           3,
                           EGL_CONTEXT_OPENGL_PROFILE_MASK,
                           EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                           EGL_NONE};
  eglBindAPI(EGL_OPENGL_API);
  context_ = eglCreateContext(display_, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, wanted);
  if (context_ == EGL_NO_CONTEXT) {
    eglTerminate(display_);
    no_driver("it has no OpenGL 3.3");
  }
  make_current();
}

OffscreenContext::~OffscreenContext() {
  eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglDestroyContext(display_, context_);
  eglTerminate(display_);
}

void OffscreenContext::make_current() {
  if (eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) != EGL_TRUE) {
    no_driver("its context does not become current");
  }
}

}  // namespace verp::render
