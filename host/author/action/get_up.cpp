#include "host/author/action/get_up.hpp"

#include <filesystem>
#include <utility>

#include "host/author/action/compile.hpp"
#include "host/author/action/folder.hpp"
#include "host/robot/model/load_error.hpp"

namespace verp::action {

void take_get_up_actions(session::WalkPlan& plan) {
  const auto folder = folder_of(plan.entity.file);
  const CompiledActions made = make_library(plan.params, read_folder(folder));
  // A start on one side needs no action for the other.
  const sim::Lies lies = plan.twin.lies;
  if (lies != sim::Lies::kBack) made.require(kGetUpFront, folder.string());
  if (lies != sim::Lies::kFront) made.require(kGetUpBack, folder.string());
  plan.actions = made.words;
}

std::string offer_get_up_actions(session::WalkPlan& plan) {
  if (plan.get_ups > 0) return "";  // it has them
  try {
    const auto folder = folder_of(plan.entity.file);
    CompiledActions made = make_library(plan.params, read_folder(folder));
    const bool both = made.number(kGetUpFront) != 0 && made.number(kGetUpBack) != 0;
    if (both) plan.actions = std::move(made.words);
    take_lie_down(plan);  // if it has no others
  } catch (const model::LoadError& error) {
    return error.what();
  }
  return "";
}

void take_lie_down(session::WalkPlan& plan) {
  const auto file = folder_of(plan.entity.file) / (std::string(kLieDown) + ".action");
  if (!plan.actions.empty() || !std::filesystem::exists(file)) return;
  plan.actions = make_library(plan.params, read_with_linked(file)).words;
}

}  // namespace verp::action
