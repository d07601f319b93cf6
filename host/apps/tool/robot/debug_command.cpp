#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>

#include "host/apps/cli/console.hpp"
#include "host/apps/cli/interrupt.hpp"
#include "host/apps/cli/other_program.hpp"
#include "host/apps/tool/firmware_build.hpp"
#include "host/apps/tool/robot/commands.hpp"
#include "host/apps/tool/robot/flash_run.hpp"
#include "host/boards/board/emulated_board.hpp"
#include "host/boards/flash/debugger.hpp"
#include "host/boards/flash/flasher.hpp"
#include "host/boards/flash/images.hpp"
#include "host/boards/flash/recipe.hpp"
#include "host/os/files/places.hpp"
#include "host/os/files/shell_line.hpp"
#include "host/trace/record/trace.hpp"

namespace verp::tool {
namespace {

namespace fs = std::filesystem;

struct DebugWords {
  FlashOptions flash;
  std::string trace, gdb = "gdb-multiarch";
  std::uint32_t tick = 0;
  bool tick_given = false, print = false;
};

bool is_emulated(const std::string& board) {
  const auto& all = board::emulated_boards();
  return std::any_of(all.begin(), all.end(), [&](const auto& each) { return each.name == board; });
}

/// The emulated board that replays a trace for this board.
std::string replay_board(const std::string& board) {
  return is_emulated(board) ? board : flash::find_recipe(board).replay_board;
}

/// Builds with debug information. If $VERP_FIRMWARE_DIR is set, uses its images unchanged.
void build_for_gdb(const std::string& board, const std::string& target, const fs::path& folder) {
  if (std::getenv("VERP_FIRMWARE_DIR") != nullptr) return;
  const fs::path tree = files::source_dir() / "build" / ("debug-" + board);
  if (!fs::exists(tree))
    cli::complain("verp debug: building " + target + ": the first time takes minutes");
  cli::Progress progress(true);
  build_firmware({.board = board,
                  .target = target,
                  .tree = tree,
                  .settings = {"-DCMAKE_CXX_FLAGS_RELEASE=-O2 -g -DNDEBUG"},
                  .log = folder / "build.log"},
                 progress);
  setenv("VERP_FIRMWARE_DIR", (tree / "images").c_str(), 1);
}

flash::DebugPlan plan_replay(const DebugWords& words, const fs::path& folder) {
  const record::Trace trace = record::read_trace(words.trace);
  if (trace.before) {
    throw cli::ToolError(cli::kBadInput,
                         "verp debug: " + words.trace +
                             ": begins in the midst of a run, and firmware cannot; give the "
                             "trace that it was cut from");
  }
  std::vector<Inputs> inputs;
  for (const TickRecord& each : trace.ticks) inputs.push_back(each.inputs);
  const auto at = std::find_if(inputs.begin(), inputs.end(), [&](const Inputs& each) {
    return !words.tick_given || each.tick == words.tick;
  });
  if (at == inputs.end()) {
    throw cli::ToolError(cli::kBadInput,
                         fmt::format("verp debug: --tick {}: {} has the ticks {} to {}", words.tick,
                                     words.trace, inputs.empty() ? 0 : inputs.front().tick,
                                     inputs.empty() ? 0 : inputs.back().tick));
  }
  const std::string board = replay_board(words.flash.board);
  if (board == "zcu102_r5") {
    throw cli::ToolError(
        cli::kBadInput,
        "verp debug: zcu102_r5: QEMU shows gdb the four cores beside this one first; "
        "give --board mps2_an386, which takes the same trace");
  }
  build_for_gdb(board, "replay_" + board, folder);
  return flash::debug_replay(words.gdb, board, trace.params, inputs,
                             static_cast<std::uint32_t>(at - inputs.begin()), folder);
}

/// True unless the board exists only in emulation: then its programs have no link for a twin.
bool has_loop_of_its_own(const std::string& board) {
  const auto& rows = flash::recipes();
  return !is_emulated(board) || std::any_of(rows.begin(), rows.end(), [&](const auto& row) {
    return row.board == board && row.chip != nullptr;
  });
}

flash::DebugPlan plan_loop(const DebugWords& words, const fs::path& folder) {
  const FlashOptions& options = words.flash;
  if (!has_loop_of_its_own(options.board)) {
    throw cli::ToolError(
        cli::kBadInput,
        fmt::format("verp debug: {}: its loop runs within a test only; give a TRACE "
                    "(verp walk --record F.mcap), over which the controller runs there, "
                    "or --board olimex_h405 --emulate",
                    options.board));
  }
  const flash::Recipe& recipe = flash::find_recipe(options.board);
  const BusProtocol protocol = bus_of(options, recipe, folder);
  build_for_gdb(options.board, flash::loop_image(recipe, protocol), folder);
  if (!options.emulate) {
    return flash::debug_chip(words.gdb, recipe, protocol, options.port);
  }
  return flash::debug_emulation(words.gdb, emulation_of(options, recipe, folder), folder);
}

void tell_links(const flash::DebugPlan& plan) {
  std::string hil;
  for (const flash::EmulatedLink& link : plan.links) {
    cli::complain(fmt::format("  {:<18}{}", link.what, link.place));
    hil += (link.what == "operator" ? " --operator " : " --link ") + link.place;
  }
  if (plan.links.size() == 2) {
    cli::complain(fmt::format("  {:<18}verp hil MODEL --lockstep{}", "a twin for it", hil));
  }
}

/// gdb then owns the terminal and Ctrl-C.
[[noreturn]] void become(const std::vector<std::string>& command) {
  std::vector<std::string> words = command;
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  ::execvp(argv[0], argv.data());
  throw cli::ToolError(cli::kNoDevice,
                       fmt::format("verp debug: {} cannot be started ({}); apt-get install "
                                   "gdb-multiarch, or name another debugger with --gdb",
                                   command[0], std::strerror(errno)));
}

int run_debug(const DebugWords& words) {
  if (words.trace.empty() && words.tick_given) {
    throw cli::ToolError(cli::kBadInput, "verp debug: --tick is one of a TRACE; give it too");
  }
  const flash::Workspace workspace("debug/" + words.flash.board);
  const flash::DebugPlan plan = words.trace.empty() ? plan_loop(words, workspace.path())
                                                    : plan_replay(words, workspace.path());
  tell_links(plan);
  if (words.print) {
    cli::answer(files::shell_line(plan.command) + "\n");
    return cli::kGood;
  }
  workspace.hand_over();
  become(plan.command);
}

}  // namespace

cli::Subcommand add_debug(CLI::App& root) {
  CLI::App* app = cli::declare_other(root, "debug");
  auto words = std::make_shared<DebugWords>();
  app->add_option("TRACE", words->trace,
                  "run the controller over this trace's inputs, on the board's emulated core; "
                  "without: the board's control loop");
  app->add_option("--board", words->flash.board, "a board of boards/")->required();
  CLI::Option* tick = app->add_option("--tick", words->tick,
                                      "stop where the controller takes "
                                      "this tick of the trace (default: its first)");
  app->add_flag("--emulate", words->flash.emulate,
                "the board in QEMU, not the one behind a debug probe");
  app->add_option("--robot", words->flash.params,
                  "the robot in the emulated board's memory: a name, an SDF file or a Params image")
      ->needs("--emulate");
  app->add_option("--bus", words->flash.bus,
                  "name of the robot's bus, which decides which firmware (default: its first)");
  app->add_option("--port", words->flash.port,
                  "serial number of the debug probe, where there are several");
  app->add_option("--gdb", words->gdb, "the debugger")->capture_default_str();
  app->add_flag("--print", words->print,
                "print gdb's command line, for an editor or a script, and run nothing");
  return {app, [words, tick] {
            words->tick_given = tick->count() > 0;
            return run_debug(*words);
          }};
}

}  // namespace verp::tool
