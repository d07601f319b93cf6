#pragma once
#include <string>

#include "host/apps/tool/walk_options.hpp"
#include "host/author/action/compile.hpp"
#include "host/robot/model/entity.hpp"

/// What every subcommand of `verp action` is told, and the robot that it means.
namespace verp::tool {

struct ActionWords {
  std::string action;  ///< its name, or a file
  std::string model = "generic21";
  bool json = false;
  WalkOptions walk;         ///< of the twin
  bool held = false;        ///< by its trunk, all the time
  int gains_percent = 100;  ///< of the servos' position loops
};

struct ActionRobot {
  model::Entity entity;
  Params params;
  action::Made made;
};

/// With the actions beside its file; a file that was named is one of them, in place of one of its
/// name, and so are those that it leads to in its own folder. Throws LoadError.
ActionRobot load_action_robot(const ActionWords& words);

/// Number of the action that was named. Throws LoadError.
int require_action(const ActionRobot& robot, const ActionWords& words);

/// The same of a robot that is loaded already. `named`: an action of its own, or a file.
action::Made make_actions(const model::Entity& entity, const Params& params,
                          const std::string& named);
int require_action(const model::Entity& entity, const action::Made& made, const std::string& named);

/// The position loops of all servos at so many percent of what they were.
void soften(model::Entity& entity, int percent);

}  // namespace verp::tool
