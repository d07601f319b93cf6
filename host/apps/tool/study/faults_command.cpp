#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "host/apps/cli/command.hpp"
#include "host/apps/cli/console.hpp"
#include "host/apps/cli/exit_status.hpp"
#include "host/apps/cli/interrupt.hpp"
#include "host/apps/cli/other_program.hpp"
#include "host/apps/cli/progress.hpp"
#include "host/apps/tool/study/commands.hpp"
#include "host/robot/model/find.hpp"
#include "host/robot/model/load.hpp"
#include "host/run/scenario/expand.hpp"
#include "host/run/scenario/field_bugs.hpp"
#include "host/study/survey/workers.hpp"

namespace verp::tool {
namespace {

using scenario::Catcher;
using scenario::FieldBug;
using scenario::Trial;

struct FaultsWords {
  std::string robot = "generic21";
  bool run = false;
  unsigned jobs = 0;
};

/// A markdown cell.
std::string cell(std::string text) {
  for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2)
    text.insert(at, 1, '\\');
  return text;
}

std::string list(const model::Entity& entity) {
  std::string text;
  for (const FieldBug& bug : scenario::field_bugs()) {
    text +=
        fmt::format("  {:<20}{:<17}{}\n{:<39}{}; caught by {}\n", bug.name, in_words(bug.family),
                    bug.what, "", how(bug, entity), in_words(bug.catcher));
  }
  return text +
         "What catches a bug was seen on generic21.\n"
         "verp walk --fault NAME injects one, verp faults --run each\n";
}

std::string row(const FieldBug& bug, const Trial& trial, const model::Entity& entity) {
  std::string thread = bug.thread;
  const std::size_t mark = thread.find('#');
  if (mark != std::string::npos) {
    thread = fmt::format(" ([{}](https://github.com/{}/issues/{}))", thread, thread.substr(0, mark),
                         thread.substr(mark + 1));
  }
  const bool expected = bug.catcher == Catcher::kNobody && trial.catcher == bug.catcher;
  const bool awake = trial.catcher == Catcher::kTable || trial.catcher == Catcher::kTwin;
  const std::string after = trial.after_s < 0 ? "at the end" : fmt::format("{:.2f}", trial.after_s);
  return fmt::format("| {} | {}{} | `{}` | {} | {} | {} |\n", bug.name, cell(bug.what), thread,
                     cell(how(bug, entity)), in_words(trial.catcher), awake ? after : "",
                     cell(expected ? bug.word : trial.line));
}

std::vector<Trial> try_all(const model::Entity& entity, unsigned jobs) {
  const auto bugs = scenario::field_bugs();
  std::vector<Trial> trials(bugs.size());
  cli::Progress progress(true);
  const survey::Watch watch{.interrupted = cli::interrupted,
                            .went_on = [&](double share) { progress.show(share, "field bugs"); },
                            .threads = jobs};
  survey::Workers workers(watch, bugs.size());
  std::mutex reader;  // libsdformat's settings are global
  workers.run(bugs.size(), [&](std::size_t i) {
    std::unique_lock<std::mutex> lock(reader, std::defer_lock);
    if (bugs[i].in_file()) lock.lock();
    try {
      trials[i] = try_bug(bugs[i], entity);
    } catch (const scenario::ScenarioError& error) {
      trials[i].line = fmt::format("not injected: {}", error.what());
    }
    workers.step_done();
  });
  progress.clear();
  return trials;
}

/// The manual's page.
std::string page(const model::Entity& entity, const std::vector<Trial>& trials) {
  const auto bugs = scenario::field_bugs();
  std::string text;
  std::size_t caught = 0;
  for (std::size_t i = 0; i < bugs.size(); ++i) {
    caught += trials[i].catcher != Catcher::kNobody ? 1 : 0;
    if (i == 0 || bugs[i].family != bugs[i - 1].family) {
      text += fmt::format(
          "\n## {}\n\n| Bug | What is wrong | Injected by | Caught by | After, s | What the user "
          "reads |\n|---|---|---|---|---|---|\n",
          in_words(bugs[i].family));
    }
    text += row(bugs[i], trials[i], entity);
  }
  return fmt::format(
             "# Field bugs\n\nMistakes that builders of robots reported in public, each injected "
             "into a walk of {} of 5 s at 0.15 m/s.\n`./verp walk --fault NAME` injects one, "
             "`./verp check --fault NAME` one in the robot's file. `./verp faults --run` "
             "made\nthis "
             "page: edit nothing here. **{} of {} are caught.** A bug that only raises a remark "
             "ends "
             "with status 0.\n",
             entity.name, caught, bugs.size()) +
         text;
}

int run_faults(const FaultsWords& words) {
  const model::Entity entity = model::load_robot(model::find_model(words.robot));
  if (!words.run) return cli::answer(list(entity)), cli::kGood;
  const std::vector<Trial> trials = try_all(entity, words.jobs);
  if (cli::interrupted()) {
    cli::complain("verp faults: interrupted");
    return cli::kRunFailed;
  }
  cli::answer(page(entity, trials));
  return cli::kGood;
}

}  // namespace

cli::Subcommand add_faults(CLI::App& root) {
  CLI::App* app = cli::declare_other(root, "faults");
  auto words = std::make_shared<FaultsWords>();
  app->add_flag("--run", words->run, "inject each in turn, and print who caught it as markdown");
  app->add_option("--robot", words->robot, "a robot by its name, or the path of its SDF file")
      ->capture_default_str();
  app->add_option("-j,--jobs", words->jobs, "walks at a time; default: one per core")
      ->check(cli::whole_number_between(1, 64));
  return {app, [words] {
            cli::catch_interrupts();
            return run_faults(*words);
          }};
}

}  // namespace verp::tool
