#include <CLI/CLI.hpp>
#include <QApplication>
#include <QSettings>
#include <QSurfaceFormat>
#include <QTimer>
#include <filesystem>
#include <memory>
#include <optional>

#include "host/apps/cli/console.hpp"
#include "host/apps/cli/interrupt.hpp"
#include "host/apps/cli/program.hpp"
#include "host/apps/tool/view_command.hpp"
#include "host/apps/view/display.hpp"
#include "host/apps/view/main_window.hpp"
#include "host/apps/view/run_of.hpp"
#include "host/apps/view/theme.hpp"
#include "host/os/link/endpoint.hpp"
#include "host/trace/record/trace.hpp"

namespace verp::view {
namespace {

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
