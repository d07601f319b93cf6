#include "host/view/display.hpp"

#include <dlfcn.h>
#include <unistd.h>

#include <QString>
#include <cstdio>
#include <cstdlib>
#include <utility>

#include "host/tool/console.hpp"
#include "host/tool/exit_status.hpp"

namespace verp::view {
namespace {

std::function<std::string()> save_before_the_end;
bool showing = false;

bool is_set(const char* name) {
  const char* value = std::getenv(name);
  return value != nullptr && *value != 0;
}

/// Qt calls exit() when its connection breaks.
void at_exit() {
  if (!std::exchange(showing, false)) return;
  tool::complain("verp view: the display is gone; the run is over");
  const std::string lost = save_before_the_end ? save_before_the_end() : "";
  if (!lost.empty()) tool::complain(lost);
  ::_exit(tool::kNoDevice);
}

/// Xlib's own way to end the program, with lines of its own, asks this first.
int hear_xlib(void*) {
  at_exit();
  return 0;
}

/// Only where Qt has brought Xlib along, and without its headers.
void listen_to_xlib() {
  using Handler = int (*)(void*);
  void* found = ::dlsym(RTLD_DEFAULT, "XSetIOErrorHandler");
  if (found != nullptr) reinterpret_cast<Handler (*)(Handler)>(found)(hear_xlib);
}

void hear_qt(QtMsgType type, const QMessageLogContext&, const QString& text) {
  if (type == QtFatalMsg) {  // before there is a window: no platform could start
    tool::complain("verp view: the display " +
                   std::string(std::getenv("DISPLAY") ? std::getenv("DISPLAY") : "") +
                   " cannot be opened; is DISPLAY right? Without one, try `verp shot` or "
                   "`xvfb-run ./verp view`");
    ::_exit(tool::kNoDevice);
  }
  if (type == QtCriticalMsg) tool::complain("verp view: " + text.toStdString());
}

}  // namespace

std::string no_display() {
  qInstallMessageHandler(hear_qt);
  if (is_set("QT_QPA_PLATFORM") || is_set("DISPLAY") || is_set("WAYLAND_DISPLAY")) return "";
  return "verp view: no display here (neither DISPLAY nor WAYLAND_DISPLAY is set); log in to a "
         "desktop, or use `verp walk --report`";
}

void survive_the_display(std::function<std::string()> save) {
  save_before_the_end = std::move(save);
  showing = true;
  listen_to_xlib();
  std::atexit(at_exit);
}

void leave_the_display() {
  showing = false;
}

}  // namespace verp::view
