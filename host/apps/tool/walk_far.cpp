#include <fmt/format.h>

#include "host/apps/cli/exit_status.hpp"
#include "host/apps/tool/walk_plan.hpp"
#include "host/author/action/compile.hpp"
#include "host/author/action/folder.hpp"
#include "host/boards/flash/recipe.hpp"
#include "host/robot/model/load_error.hpp"

namespace verp::tool {

void check_board(const WalkOptions& options) {
  if (options.board.empty()) return;
  std::string names;
  for (const flash::Recipe& each : flash::recipes()) {
    if (each.chip != nullptr) continue;  // its loop speaks to a twin by a port, not by semihosting
    if (options.board == each.board) return;
    names += (names.empty() ? "" : ", ") + std::string(each.board);
  }
  throw cli::ToolError(
      cli::kBadInput,
      fmt::format("verp walk: --on {}: no emulated board that takes its twin from here; "
                  "give one of: {}; others walk in `./verp test --on BOARD`",
                  options.board, names));
}

void take_get_up_actions(session::WalkPlan& plan) {
  const auto folder = action::folder_of(plan.entity.file);
  const action::Made made = action::make_library(plan.params, action::read_folder(folder));
  // One that is put down on one side needs no way up from the other.
  const sim::Lies lies = plan.twin.lies;
  if (lies != sim::Lies::kBack) made.require(action::kGetUpFront, folder.string());
  if (lies != sim::Lies::kFront) made.require(action::kGetUpBack, folder.string());
  plan.actions = made.words;
  plan.get_ups = session::kGetUpTries;
}

std::string offer_get_up_actions(session::WalkPlan& plan) {
  if (!plan.actions.empty()) return "";
  try {
    const auto folder = action::folder_of(plan.entity.file);
    action::Made made = action::make_library(plan.params, action::read_folder(folder));
    const bool both = made.number(action::kGetUpFront) != 0 && made.number(action::kGetUpBack) != 0;
    if (both) plan.actions = std::move(made.words);
  } catch (const model::LoadError& error) {
    return error.what();
  }
  return "";
}

}  // namespace verp::tool
