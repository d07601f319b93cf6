#include "host/apps/view/display.hpp"

#include <dlfcn.h>
#include <fcntl.h>
#include <unistd.h>

#include <QGuiApplication>
#include <QOffscreenSurface>
#include <QOpenGLContext>
#include <QString>
#include <cstdio>
#include <cstdlib>
#include <utility>

#include "host/apps/cli/console.hpp"
#include "host/apps/cli/exit_status.hpp"

namespace verp::view {
namespace {

std::function<std::string()> save_before_the_end;
bool showing = false, heard = false;

/// libGL cannot be silenced: users get our one line instead.
int real_stderr = -1;

void silence_drivers() {
  const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (nowhere < 0) return;
  real_stderr = ::fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 3);
  if (real_stderr >= 0) ::dup2(nowhere, STDERR_FILENO);
  ::close(nowhere);
}

void hear_drivers() {
  if (real_stderr < 0) return;
  ::dup2(real_stderr, STDERR_FILENO);
  ::close(std::exchange(real_stderr, -1));
}

bool is_set(const char* name) {
  const char* value = std::getenv(name);
  return value != nullptr && *value != 0;
}

/// Qt calls exit() when its connection breaks.
void at_exit() {
  if (!std::exchange(showing, false)) return;
  hear_drivers();
  cli::complain("verp view: the display is gone; the run is over");
  const std::string lost = save_before_the_end ? save_before_the_end() : "";
  if (!lost.empty()) cli::complain(lost);
  ::_exit(cli::kNoDevice);
}

/// Xlib calls this before it prints its own lines and ends the program.
int hear_xlib(void*) {
  at_exit();
  return 0;
}

/// Needs no Xlib headers; works only if Qt has loaded Xlib.
void listen_to_xlib() {
  using Handler = int (*)(void*);
  void* found = ::dlsym(RTLD_DEFAULT, "XSetIOErrorHandler");
  if (found != nullptr) reinterpret_cast<Handler (*)(Handler)>(found)(hear_xlib);
}

void hear_qt(QtMsgType type, const QMessageLogContext&, const QString& text) {
  if (type == QtFatalMsg) {
    hear_drivers();
    cli::complain("verp view: the display " +
                  std::string(std::getenv("DISPLAY") ? std::getenv("DISPLAY") : "") +
                  " cannot be opened; is DISPLAY right? Without one, try `verp shot` or "
                  "`xvfb-run ./verp view`");
    ::_exit(cli::kNoDevice);
  }
  if (type == QtCriticalMsg) cli::complain("verp view: " + text.toStdString());
}

}  // namespace

std::string no_display() {
  ::setenv("EGL_LOG_LEVEL", "fatal", 0);  // our message instead
  qInstallMessageHandler(hear_qt);
  if (is_set("QT_QPA_PLATFORM") || is_set("DISPLAY") || is_set("WAYLAND_DISPLAY")) return "";
  return "verp view: no display here (neither DISPLAY nor WAYLAND_DISPLAY is set); log in to a "
         "desktop, or use `verp walk --report`";
}

std::string no_driver() {
  const std::string fix =
      "; Debian's software driver is enough: apt-get install libgl1-mesa-dri. Without one, use "
      "`verp walk --report`";
  const QString platform = QGuiApplication::platformName();
  if (platform == "offscreen" || platform == "minimal") {
    return "verp view: QT_QPA_PLATFORM=" + platform.toStdString() +
           " has no windows; unset it, or use `verp shot`";
  }
  silence_drivers();
  QOffscreenSurface surface;
  surface.create();
  QOpenGLContext context;
  const bool starts = context.create() && context.makeCurrent(&surface);
  const auto version = context.format().version();
  if (starts) context.doneCurrent();
  hear_drivers();
  if (!starts) return "verp view: no window without a GL driver: none starts on this display" + fix;
  if (version >= qMakePair(3, 3)) return "";
  return "verp view: no window without a GL driver of OpenGL 3.3: this display's has " +
         std::to_string(version.first) + "." + std::to_string(version.second) + fix;
}

void survive_the_display(std::function<std::string()> save) {
  save_before_the_end = std::move(save);
  listen_to_xlib();
  if (!std::exchange(heard, true)) std::atexit(at_exit);
  showing = true;
}

void leave_the_display() {
  showing = false;
}

}  // namespace verp::view
