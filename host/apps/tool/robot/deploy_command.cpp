#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "host/apps/cli/command.hpp"
#include "host/apps/cli/console.hpp"
#include "host/apps/cli/failure.hpp"
#include "host/apps/cli/interrupt.hpp"
#include "host/apps/cli/json.hpp"
#include "host/apps/cli/other_program.hpp"
#include "host/apps/tool/firmware_build.hpp"
#include "host/apps/tool/robot/commands.hpp"
#include "host/apps/tool/robot/flash_run.hpp"
#include "host/apps/tool/walk_run.hpp"
#include "host/boards/board/board_error.hpp"
#include "host/boards/board/replay_on_target.hpp"
#include "host/boards/flash/flash_error.hpp"
#include "host/boards/flash/flasher.hpp"
#include "host/boards/flash/images.hpp"
#include "host/boards/flash/recipe.hpp"
#include "host/run/scenario/expand.hpp"
#include "host/trace/record/trace_writer.hpp"

namespace verp::tool {
namespace {

namespace fs = std::filesystem;

struct DeployOptions {
  std::string model;
  double walk_s = 10;
  FlashOptions flash;
  bool no_build = false, json = false;
};

struct StepAnswer {
  std::string text;
  cli::Json json = cli::Json::object();
};

/// The steps from a model to a robot. Each step returns a result or throws; a dry run describes it.
class Deployment {
 public:
  explicit Deployment(const DeployOptions& options)
      : options_(options),
        recipe_(flash::find_recipe(options.flash.board)),
        folder_(flash::work_root() / "deploy" / options.flash.board),
        progress_(!options.json) {
    scenario::Robot robot;
    robot.model = options.model;
    robot.bus = options.flash.bus;
    plan_ = scenario::plan_of(robot, options.walk_s);
    image_ = flash::loop_image(recipe_, plan_.entity.protocol);
  }

  StepAnswer build() {
    if (options_.no_build) return {"left out (--no-build)"};
    const std::string images = fmt::format("{}, replay_{}", image_, recipe_.replay_board);
    if (dry()) return {"would build " + images};
    const std::string replay = std::string("replay_") + recipe_.replay_board;
    const fs::path log = folder() / "build.log";
    build_firmware({.board = options_.flash.board, .target = image_, .tree = {}, .log = log},
                   progress_);
    build_firmware({.board = recipe_.replay_board, .target = replay, .tree = {}, .log = log},
                   progress_);
    return {images};
  }

  /// Walks in the twin, with this PC as controller; records the inputs.
  StepAnswer walk() {
    if (dry()) return {fmt::format("would walk {:g} s in the twin", plan_.walk_s)};
    const fs::path file = folder() / "walk.mcap";
    record::TraceWriter writer(file, plan_.params, {{"robot", plan_.params.name}});
    const WalkResult result =
        tool::walk(plan_, &writer, progress_, "walk of " + std::string(plan_.params.name));
    progress_.clear();
    if (!result.trace_failure.empty()) throw cli::ToolError(cli::kRunFailed, result.trace_failure);
    writer.close();
    if (result.interrupted) throw cli::ToolError(cli::kRunFailed, "interrupted");
    if (!result.good()) {
      throw cli::ToolError(cli::kRunFailed, fmt::format("{}; `verp trace export {}` shows the run",
                                                        result.failure, file.string()));
    }
    trace_ = record::read_trace(file);
    return {fmt::format("{} ticks, digest 0x{:016x}", result.ticks, result.digest),
            {{"ticks", result.ticks},
             {"digest", fmt::format("0x{:016x}", result.digest)},
             {"trace", file.string()}}};
  }

  /// Equal inputs must give equal bits on a core like the board's.
  StepAnswer replay() {
    const std::string board = recipe_.replay_board;
    if (dry()) return {"would replay that walk on emulated " + board};
    std::vector<Inputs> inputs;
    for (const TickRecord& tick : trace_.ticks) inputs.push_back(tick.inputs);
    progress_.show(0, "replay on " + board);
    const board::TargetReplay there = board::replay_on(board, trace_.params, inputs);
    progress_.clear();
    for (std::size_t i = 0; i < trace_.ticks.size(); ++i) expect_same(i, there.digests[i]);
    const bool itself = board == options_.flash.board;
    return {fmt::format("{} ticks on emulated {}{}, every stage the same bits", inputs.size(),
                        board, itself ? "" : ", which has the same core"),
            {{"board", board}, {"ticks", inputs.size()}, {"same_board", itself}}};
  }

  StepAnswer flash() {
    FlashOptions options = options_.flash;
    options.stay = false;
    if (recipe_.chip != nullptr) options.params = options_.model;
    try {
      FlashAnswer answer = flash_board(options, progress_, [](const std::string&) {});
      while (!answer.text.empty() && answer.text.back() == '\n') answer.text.pop_back();
      return {(dry() ? "would run:\n" : "") + answer.text, answer.json};
    } catch (const flash::FlashError& error) {
      if (error.kind() != flash::FlashError::Kind::kBadFile || !builds_later()) throw;
    } catch (const board::NoSuchBoard&) {
      if (!builds_later()) throw;
    }
    return {
        fmt::format("would flash {}, which is not built yet; after that, --dry-run tells the "
                    "commands",
                    image_)};
  }

 private:
  bool dry() const { return options_.flash.dry_run; }
  /// In a dry run, a later build may still correct the image.
  bool builds_later() const { return dry() && !options_.no_build; }

  const fs::path& folder() const {
    std::error_code error;
    fs::create_directories(folder_, error);
    if (error) {
      throw cli::ToolError(cli::kBadInput,
                           folder_.string() + ": cannot be made; build as the user who owns " +
                               folder_.parent_path().string() + ", or set VERP_FLASH_DIR");
    }
    return folder_;
  }

  void expect_same(std::size_t index, const TickDigest& there) const {
    const TickRecord& here = trace_.ticks[index];
    for (int stage = 0; stage < kStages; ++stage) {
      if (here.digest.stage[stage] == there.stage[stage]) continue;
      throw cli::ToolError(
          cli::kRunFailed,
          fmt::format("{} differs from this PC at tick {} in stage {}; please report it",
                      recipe_.replay_board, here.inputs.tick, kStageNames[stage]));
    }
  }

  const DeployOptions& options_;
  const flash::Recipe& recipe_;
  std::string image_;  ///< for the robot on its bus
  fs::path folder_;
  cli::Progress progress_;
  WalkPlan plan_;
  record::Trace trace_;
};

struct NamedStep {
  const char* name;
  StepAnswer (Deployment::*run)();
};
constexpr NamedStep kSteps[] = {{"build", &Deployment::build},
                                {"walk", &Deployment::walk},
                                {"replay", &Deployment::replay},
                                {"flash", &Deployment::flash}};

void tell(const DeployOptions& options, const std::string& line) {
  if (options.json) {
    cli::complain(line);
  } else {
    cli::answer(line + "\n");
    std::fflush(stdout);
  }
}

/// Stops at the first failed step; returns the exit status.
int run_steps(const DeployOptions& options, Deployment& deployment, cli::Json& rows,
              std::string& failure) {
  using Clock = std::chrono::steady_clock;
  for (const NamedStep& step : kSteps) {
    const auto begun = Clock::now();
    cli::Json row = {{"step", step.name}, {"good", true}};
    cli::Failure failed{cli::kGood, ""};
    StepAnswer answer;
    try {
      answer = (deployment.*step.run)();
      if (cli::interrupted()) throw cli::ToolError(cli::kRunFailed, "interrupted");
    } catch (...) {
      failed = cli::current_failure();
    }
    row["good"] = failed.status == cli::kGood;
    row["seconds"] = std::chrono::duration<double>(Clock::now() - begun).count();
    row.update(answer.json);
    rows.push_back(row);
    if (failed.status != cli::kGood) {
      failure = fmt::format("{}: {}", step.name, failed.line);
      return failed.status;
    }
    tell(options, fmt::format("  {:<8}{}", step.name, answer.text));
  }
  return cli::kGood;
}

int run_deploy(const DeployOptions& options) {
  Deployment deployment(options);
  cli::Json rows = cli::Json::array();
  std::string failure;
  const int status = run_steps(options, deployment, rows, failure);
  if (status != cli::kGood) cli::complain("verp deploy: " + failure);
  if (options.json) {
    cli::Json json = {{"model", options.model},
                      {"board", options.flash.board},
                      {"dry_run", options.flash.dry_run},
                      {"steps", rows}};
    if (status != cli::kGood) {
      json["error"] = failure;
      json["exit"] = status;
    }
    cli::print_json(json);
  }
  return status;
}

}  // namespace

cli::Subcommand add_deploy(CLI::App& root) {
  CLI::App* app = cli::declare_other(root, "deploy");
  auto options = std::make_shared<DeployOptions>();
  cli::add_model(*app, options->model)->required();
  cli::add_bus_option(*app, options->flash.bus);
  declare_target(*app, options->flash);
  app->add_option("--for", options->walk_s, "length of the walk, s")
      ->check(cli::number_between(3, 3600, "s"))
      ->capture_default_str();
  app->add_flag("--no-build", options->no_build, "take the images as they are");
  cli::add_json_flag(*app, options->json);
  return {app, [options] {
            cli::catch_interrupts();
            return run_deploy(*options);
          }};
}

}  // namespace verp::tool
