#pragma once
#include <string>

#include "host/apps/tool/walk_options.hpp"
#include "host/author/action/compile.hpp"
#include "host/robot/model/entity.hpp"

namespace verp::tool {

struct ActionWords {
  std::string action;  ///< name or file
  std::string model = "generic21";
  bool json = false;
  WalkOptions walk;         ///< of the twin
  bool held = false;        ///< by its trunk, throughout
  int gains_percent = 100;  ///< gains of the position loops
};

struct ActionRobot {
  model::Entity entity;
  Params params;
  action::CompiledActions made;
};

/// The robot with the actions beside its file. A named action file, and files in its folder that it
/// links to, join them or replace one of the same name. Throws LoadError.
ActionRobot load_action_robot(const ActionWords& words);

/// Throws LoadError.
int require_action(const ActionRobot& robot, const ActionWords& words);

/// `named`: one of the robot's actions, or a file.
action::CompiledActions make_actions(const model::Entity& entity, const Params& params,
                                     const std::string& named);
int require_action(const model::Entity& entity, const action::CompiledActions& made,
                   const std::string& named);

void soften(model::Entity& entity, int percent);

}  // namespace verp::tool
