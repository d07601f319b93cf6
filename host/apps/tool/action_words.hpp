#pragma once
#include <string>

#include "host/apps/tool/walk_options.hpp"
#include "host/author/action/compile.hpp"
#include "host/robot/model/entity.hpp"

/// Options common to all subcommands of `verp action`, and the robot that they name.
namespace verp::tool {

struct ActionWords {
  std::string action;  ///< name or file
  std::string model = "generic21";
  bool json = false;
  WalkOptions walk;         ///< of the twin
  bool held = false;        ///< by its trunk, throughout
  int gains_percent = 100;  ///< gains of the servos' position loops
};

struct ActionRobot {
  model::Entity entity;
  Params params;
  action::CompiledActions made;
};

/// Loads the robot with the actions beside its file. A named action file joins them and replaces
/// one of the same name, as do the files in its own folder that it links to. Throws LoadError.
ActionRobot load_action_robot(const ActionWords& words);

/// Number of the named action. Throws LoadError.
int require_action(const ActionRobot& robot, const ActionWords& words);

/// The same for a loaded robot. `named`: one of its actions, or a file.
action::CompiledActions make_actions(const model::Entity& entity, const Params& params,
                                     const std::string& named);
int require_action(const model::Entity& entity, const action::CompiledActions& made,
                   const std::string& named);

/// Scales the position gains of all servos to `percent`.
void soften(model::Entity& entity, int percent);

}  // namespace verp::tool
