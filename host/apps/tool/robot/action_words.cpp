#include "host/apps/tool/robot/action_words.hpp"

#include "host/author/action/folder.hpp"
#include "host/robot/model/find.hpp"
#include "host/robot/model/load.hpp"
#include "host/robot/model/params.hpp"

namespace verp::tool {
namespace {

bool is_file(const std::string& word) {
  return word.ends_with(".action");
}

}  // namespace

action::CompiledActions make_actions(const model::Entity& entity, const Params& params,
                                     const std::string& named) {
  std::vector<action::Document> documents = action::read_folder(action::folder_of(entity.file));
  if (is_file(named)) {
    for (const action::Document& own : action::read_with_linked(named)) {
      std::erase_if(documents, [&](const action::Document& each) { return each.name == own.name; });
      documents.push_back(own);
    }
  }
  return action::make_library(params, std::move(documents));
}

int require_action(const model::Entity& entity, const action::CompiledActions& made,
                   const std::string& named) {
  const std::string name = is_file(named) ? action::read_document(named).name : named;
  if (made.number(name) == 0 && std::filesystem::exists(named)) {
    throw model::LoadError(
        named, 0, std::filesystem::is_directory(named) ? "is a folder" : "is no action file",
        "give NAME.action, or the name of an action of the robot");
  }
  return made.require(name, action::folder_of(entity.file).string());
}

ActionRobot load_action_robot(const ActionWords& words) {
  ActionRobot robot;
  if (is_file(words.model)) {
    throw model::LoadError(words.model, 0, "is an action, no robot",
                           "give a robot, generic21 or the path of an SDF file; verp action show " +
                               words.model + " shows the action");
  }
  robot.entity = model::load_robot(model::find_model(words.model), "");
  robot.params = model::make_params(robot.entity);
  robot.made = make_actions(robot.entity, robot.params, words.action);
  return robot;
}

int require_action(const ActionRobot& robot, const ActionWords& words) {
  return require_action(robot.entity, robot.made, words.action);
}

void soften(model::Entity& entity, int percent) {
  for (model::Joint& joint : entity.joints) {
    for (std::uint16_t* gain : {&joint.servo.p_gain, &joint.servo.i_gain, &joint.servo.d_gain}) {
      *gain = static_cast<std::uint16_t>(*gain * percent / 100);
    }
  }
}

}  // namespace verp::tool
