#include <fmt/format.h>

#include "host/action/compile.hpp"
#include "host/action/folder.hpp"
#include "host/flash/recipe.hpp"
#include "host/tool/exit_status.hpp"
#include "host/tool/walk_plan.hpp"

namespace verp::tool {

void check_board(const WalkOptions& options) {
  if (options.board.empty()) return;
  std::string names;
  for (const flash::Recipe& each : flash::recipes()) {
    if (each.chip != nullptr) continue;  // its loop speaks to a twin by a port, not by semihosting
    if (options.board == each.board) return;
    names += (names.empty() ? "" : ", ") + std::string(each.board);
  }
  throw ToolError(
      kBadInput, fmt::format("verp walk: --on {}: no emulated board that takes its twin from here; "
                             "give one of: {}; others walk in `./verp test --on BOARD`",
                             options.board, names));
}

void take_get_up_actions(session::WalkPlan& plan) {
  constexpr int kTries = 3;
  const auto folder = action::folder_of(plan.entity.file);
  const action::Made made = action::make_library(plan.params, action::read_folder(folder));
  // One that is put down on one side needs no way up from the other.
  const sim::Lies lies = plan.twin.lies;
  if (lies != sim::Lies::kBack) made.require(action::kGetUpFront, folder.string());
  if (lies != sim::Lies::kFront) made.require(action::kGetUpBack, folder.string());
  plan.actions = made.words;
  plan.get_ups = kTries;
}

}  // namespace verp::tool
