#include "host/tool/action_words.hpp"

#include "host/action/folder.hpp"
#include "host/model/find.hpp"
#include "host/model/load.hpp"
#include "host/model/params.hpp"

namespace verp::tool {
namespace {

bool is_file(const std::string& word) {
  return word.ends_with(".action");
}

}  // namespace

ActionRobot load_action_robot(const ActionWords& words) {
  ActionRobot robot;
  robot.entity = model::load_robot(model::find_model(words.model), "");
  robot.params = model::make_params(robot.entity);
  std::vector<action::Document> documents =
      action::read_folder(action::folder_of(robot.entity.file));
  if (is_file(words.action)) {
    const action::Document named = action::read_document(words.action);
    std::erase_if(documents, [&](const action::Document& each) { return each.name == named.name; });
    documents.push_back(named);
  }
  robot.made = action::make_library(robot.params, std::move(documents));
  return robot;
}

int require_action(const ActionRobot& robot, const ActionWords& words) {
  const std::string name =
      is_file(words.action) ? action::read_document(words.action).name : words.action;
  return robot.made.require(name, action::folder_of(robot.entity.file).string());
}

}  // namespace verp::tool
