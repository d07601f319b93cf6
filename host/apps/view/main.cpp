#include <CLI/CLI.hpp>
#include <QApplication>
#include <QGuiApplication>
#include <QOffscreenSurface>
#include <QOpenGLContext>
#include <QSettings>
#include <QString>
#include <QSurfaceFormat>
#include <QTimer>
#include <dlfcn.h>
#include <fcntl.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "host/apps/cli/console.hpp"
#include "host/apps/cli/exit_status.hpp"
#include "host/apps/cli/interrupt.hpp"
#include "host/apps/cli/program.hpp"
#include "host/apps/tool/view_command.hpp"
#include "host/apps/view/main_window.hpp"
#include "host/apps/view/run_of.hpp"
#include "host/apps/view/theme.hpp"
#include "host/os/link/endpoint.hpp"
#include "host/trace/record/trace.hpp"

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

/// Why no window can open, or empty. Call before QApplication, which would end the program.
std::string no_display() {
  ::setenv("EGL_LOG_LEVEL", "fatal", 0);  // our message instead
  qInstallMessageHandler(hear_qt);
  if (is_set("QT_QPA_PLATFORM") || is_set("DISPLAY") || is_set("WAYLAND_DISPLAY")) return "";
  return "verp view: no display here (neither DISPLAY nor WAYLAND_DISPLAY is set); log in to a "
         "desktop, or use `verp walk --report`";
}

/// Why OpenGL 3.3 is missing, or empty. Call after QApplication and before any window, in which Qt
/// would crash.
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

/// Losing the display then calls `save`, prints one line and `save`'s, and exits with 3. Call
/// before the window is made, without `save`, and after, with it.
void survive_the_display(std::function<std::string()> save) {
  save_before_the_end = std::move(save);
  listen_to_xlib();
  if (!std::exchange(heard, true)) std::atexit(at_exit);
  showing = true;
}

void leave_the_display() {
  showing = false;
}

constexpr int kInterrupt_ms = 200;  // longest delay of Ctrl-C

int tell(const std::string& line) {
  cli::complain(line);
  return cli::kNoDevice;
}

int show(MainWindow& window) {
  QTimer interrupts;
  QObject::connect(&interrupts, &QTimer::timeout, [&] {
    if (!cli::interrupted() && !window.isHidden()) return;
    window.close();
    QApplication::quit();  // close() does not end a program without a window
  });
  interrupts.start(kInterrupt_ms);
  window.show();
  survive_the_display([&window] { return window.finish(); });
  QApplication::exec();
  leave_the_display();
  const std::string lost = window.finish();
  if (!window.failure().empty()) return tell("verp view: " + window.failure());
  if (lost.empty()) return cli::kGood;
  cli::complain("verp view: " + lost);
  return cli::kRunFailed;
}

int run_view(const tool::ViewOptions& asked) {
  tool::WalkOptions options = asked.walk;
  tool::read_robot_words(options);
  cli::catch_interrupts();
  const bool trace = options.model.ends_with(".mcap");
  std::optional<RunSetup> setup;  // mistakes are reported first
  if (trace) record::read_trace(options.model);
  if (!trace) setup = run_of(options);
  if (!asked.link.empty()) link::parse_endpoint(asked.link);
  if (trace && !asked.link.empty()) {
    throw cli::ToolError(cli::kBadInput,
                         "verp view: --link stands a controller beside a robot that runs, and " +
                             options.model + " is a trace; name a robot, or leave out --link");
  }
  if (const std::string why = no_display(); !why.empty()) return tell(why);
  QSurfaceFormat format;
  format.setVersion(3, 3);
  format.setProfile(QSurfaceFormat::CoreProfile);
  QSurfaceFormat::setDefaultFormat(format);
  int count = 1;
  char name[] = "verp view", *words[] = {name, nullptr};
  QApplication application(count, words);
  survive_the_display({});
  if (const std::string why = no_driver(); !why.empty()) {
    leave_the_display();
    return tell(why);
  }
  QApplication::setOrganizationName("verp");
  QApplication::setApplicationName("view");
  QSettings settings;
  apply_theme(application, settings.value("dark", false).toBool());
  MainWindow window(settings, [options](const std::string& model) {
    tool::WalkOptions other = options;
    other.model = model;
    other.team = {};
    other.bus.clear();
    other.record_file.clear();
    return run_of(other);
  });
  if (!asked.link.empty()) window.link_to(asked.link);
  window.steer_by(asked.gamepad);
  trace ? window.watch(std::filesystem::path(options.model)) : window.watch(std::move(*setup));
  return show(window);
}

/// An earlier error must not look like a lost display.
int run_view_and_leave(const tool::ViewOptions& asked) {
  try {
    return run_view(asked);
  } catch (...) {
    leave_the_display();
    throw;
  }
}

std::vector<cli::Subcommand> commands(CLI::App& root) {
  auto options = std::make_shared<tool::ViewOptions>();
  CLI::App* app = tool::declare_view(root, *options);
  return {{app, [app, options] {
             options->walk.typed = tool::typed_options(*app);
             options->walk.changed = tool::changed_options(*app);
             return run_view_and_leave(*options);
           }}};
}

}  // namespace

}  // namespace verp::view

int main(int argc, char** argv) {
  return verp::cli::run_program(argc, argv, verp::view::commands);
}
